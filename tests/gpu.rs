//! GPU cases: they share one session, are skipped and counted where no adapter exists, and fail there instead when
//! `SHADOWGRAPH_REQUIRE_GPU=1`.

use libtest_mimic::{Failed, Trial};
use shadowgraph_wgpu::Session;

/// Whether a missing adapter is a failure.
pub fn is_required() -> bool {
    std::env::var("SHADOWGRAPH_REQUIRE_GPU").is_ok_and(|value| value == "1")
}

/// A trial that needs a device; ignored (and so counted) where there is none.
pub fn trial(name: String, run: impl FnOnce(&Session) -> Result<(), Failed> + Send + 'static) -> Trial {
    let missing = !is_required() && Session::shared().is_err();
    Trial::test(name, move || match Session::shared() {
        Ok(session) => run(session),
        Err(problem) => Err(format!("no device: {problem}").into()),
    })
    .with_ignored_flag(missing)
}
