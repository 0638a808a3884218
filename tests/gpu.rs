//! GPU cases: they share one session, are skipped and counted where no adapter exists, and fail there instead when
//! `SHADOWGRAPH_REQUIRE_GPU=1`.

use libtest_mimic::{Failed, Trial};
use shadowgraph_wgpu::session::Session;
use std::sync::{Mutex, OnceLock};

static SESSION: OnceLock<Result<Mutex<Session>, String>> = OnceLock::new();

fn session() -> &'static Result<Mutex<Session>, String> {
    SESSION.get_or_init(|| Session::new(None).map(Mutex::new).map_err(|problem| problem.to_string()))
}

/// Whether a missing adapter is a failure.
pub fn is_required() -> bool {
    std::env::var("SHADOWGRAPH_REQUIRE_GPU").is_ok_and(|value| value == "1")
}

/// A trial that needs a device; ignored (and so counted) where there is none.
pub fn trial(name: String, run: impl FnOnce(&Session) -> Result<(), Failed> + Send + 'static) -> Trial {
    let missing = !is_required() && session().is_err();
    Trial::test(name, move || match session() {
        Ok(session) => run(&session.lock().unwrap_or_else(|poisoned| poisoned.into_inner())),
        Err(problem) => Err(format!("no device: {problem}").into()),
    })
    .with_ignored_flag(missing)
}
