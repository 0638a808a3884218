//! The checks, one function each.

use super::runs::{Values, compare, compare_nodes};
use super::{Check, Difference, Plans, Settings, Verdict};
use crate::engine::Machine;
use crate::job::Job;
use crate::trial::Trial;
use shadowgraph_core::pass::Contract;
use shadowgraph_core::plan::{Backend, Node, Plan};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_cpu::Progress;
use shadowgraph_wgpu::Options;

/// Passes that fit something to the view-samples they are given: parts of them are answered in other ways than the whole.
const FITTED_TO_PARTS: &[&str] = &["multi_shadow_map"];

/// What every check reads.
struct Ground<'a> {
    machine: &'a Machine,
    plans: Plans<'a>,
    job: &'a Job,
    /// One plain run.
    base: Values<'a>,
}

/// Timers off, everything else as it is by default.
fn plain() -> Options {
    Options { timers: false, ..Options::default() }
}

/// All of them.
pub fn all(
    machine: &Machine,
    plans: Plans,
    job: &Job,
    settings: &Settings,
    progress: &Progress,
) -> Result<Vec<Check>, Problem> {
    let base = Values::run(machine, plans.kept, job, &plain())?;
    let ground = Ground { machine, plans, job, base };
    let orders = (1..=u64::from(settings.orders)).map(|seed| ("order", format!("legal order of seed {seed}")));
    let threads =
        thread_counts().map(|count| ("threads", format!("{count} CPU thread{}", if count == 1 { "" } else { "s" })));
    let mut wanted: Vec<(&'static str, String)> = vec![("again", "the same run once more".into())];
    wanted.extend(orders);
    wanted.extend([
        ("poison", "device memory filled with set bits".into()),
        ("sharing", "transients share memory, or have their own".into()),
        ("submissions", "a submission for each node, or one for all".into()),
        ("frames", format!("frame {} against the first", settings.frames.max(2))),
    ]);
    wanted.extend(threads);
    wanted.push(("ranges", format!("view-samples in {} parts, or whole", settings.ranges.max(2))));
    let total = wanted.len() as u64;
    let (mut order, mut pool) = (0, thread_counts().into_iter());
    let mut checks = Vec::with_capacity(wanted.len());
    for (done, (check, what)) in wanted.into_iter().enumerate() {
        progress(&what, done as u64, total);
        let verdict = match check {
            "again" => ground.again(&plain())?,
            "order" => {
                order += 1;
                ground.order(order)?
            }
            "poison" => ground.poison()?,
            "sharing" => ground.sharing()?,
            "submissions" => ground.submissions()?,
            "frames" => ground.frames(settings.frames.max(2))?,
            "threads" => ground.threads(pool.next().unwrap_or(1))?,
            "ranges" => ground.ranges(settings.ranges.max(2))?,
            other => unreachable!("no check {other}"),
        };
        checks.push(Check { check, what, verdict });
    }
    Ok(checks)
}

/// One, two, and as many as there are, or more than that where these are few.
fn thread_counts() -> [usize; 3] {
    let all = std::thread::available_parallelism().map_or(1, usize::from);
    [1, 2, if all > 2 { all } else { 5 }]
}

impl<'a> Ground<'a> {
    fn has(&self, backend: Backend) -> bool {
        self.plans.kept.nodes.iter().any(|node| node.on == backend)
    }

    fn again(&self, options: &Options) -> Result<Verdict, Problem> {
        let other = Values::run(self.machine, self.plans.kept, self.job, options)?;
        Ok(compare(&self.base, &other, self.job))
    }

    fn order(&self, seed: u64) -> Result<Verdict, Problem> {
        let kept = self.plans.kept;
        let order = kept.shuffled_order(seed);
        if order.iter().copied().eq(0..kept.nodes.len()) && self.only_order(kept) {
            return Ok(not_applicable("the graph has one legal order"));
        }
        let plan = kept.in_order(&order)?;
        let other = Values::run(self.machine, &plan, self.job, &plain())?;
        Ok(compare(&self.base, &other, self.job))
    }

    /// Whether each node reads what the one before makes.
    fn only_order(&self, plan: &Plan) -> bool {
        let reads = |pair: &[shadowgraph_core::plan::Node]| {
            pair[1].inputs.iter().any(|(_, slot)| pair[0].outputs.iter().any(|(_, made)| made == slot))
        };
        plan.nodes.windows(2).all(reads)
    }

    fn poison(&self) -> Result<Verdict, Problem> {
        if !self.has(Backend::Wgpu) {
            return Ok(not_applicable(
                "on the CPU every output is a new array, written as a whole; no memory is handed over",
            ));
        }
        self.again(&Options { poison: true, ..plain() })
    }

    /// Outputs of the plan whose transients share memory against those of the plan where they do not.
    fn sharing(&self) -> Result<Verdict, Problem> {
        let shared = self.plans.shared;
        if !self.has(Backend::Wgpu) {
            return Ok(not_applicable("on the CPU no two values share memory"));
        }
        let other = Values::run(self.machine, shared, self.job, &plain())?;
        let verdict = compare(&self.base, &other, self.job);
        if !matches!(verdict, Verdict::Differs { .. }) {
            return Ok(verdict);
        }
        // An output is wrong. Values before it are kept one at a time, all others sharing memory as before.
        for node in &shared.nodes {
            for (_, slot) in &node.outputs {
                let mut plan = shared.clone();
                plan.slots[*slot].keep = true;
                plan.slots[*slot].alias = shared.slots.len() + slot;
                let other = Values::run(self.machine, &plan, self.job, &plain())?;
                let Verdict::Differs { ports } = compare(&self.base, &other, self.job) else { continue };
                let is_here = |difference: &&Difference| difference.node == node.id;
                if let Some(first) = ports.iter().find(is_here) {
                    let first = Difference { begins_here: true, ..first.clone() };
                    let after = ports.iter().filter(|port| port.node != node.id);
                    let after = after.map(|port| Difference { begins_here: false, ..port.clone() });
                    return Ok(Verdict::Differs { ports: std::iter::once(first).chain(after).collect() });
                }
            }
        }
        Ok(verdict)
    }

    fn submissions(&self) -> Result<Verdict, Problem> {
        if !self.has(Backend::Wgpu) {
            return Ok(not_applicable("the CPU has no submissions"));
        }
        self.again(&Options { timers: true, ..plain() })
    }

    fn frames(&self, frames: u32) -> Result<Verdict, Problem> {
        let silent = |_: &str, _: u64, _: u64| {};
        let mut trial = Trial::new(self.machine, self.plans.kept, self.job, &[], &plain(), &silent)?;
        let first = Values::of(self.plans.kept, self.job, trial.outcome().values.clone());
        for _ in 1..frames {
            trial.frame(false)?;
        }
        let last = Values::of(self.plans.kept, self.job, trial.values()?);
        Ok(compare(&first, &last, self.job))
    }

    fn threads(&self, count: usize) -> Result<Verdict, Problem> {
        if !self.has(Backend::Cpu) {
            return Ok(not_applicable("no node runs on the CPU"));
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build().map_err(|error| {
            Problem::new(Kind::Device, "threads cannot be started")
                .found(error.to_string())
                .remedy("free some resources")
        })?;
        let other = pool.install(|| Values::run(self.machine, self.plans.kept, self.job, &plain()))?;
        Ok(compare(&self.base, &other, self.job))
    }

    /// Whole against in parts. Values by cell are those of a part, so only what has a row a view-sample or a pixel is compared; and not what
    /// may hold more than it must, for how much more is a matter of the cells.
    fn ranges(&self, count: u32) -> Result<Verdict, Problem> {
        let fits = self.plans.kept.nodes.iter().find(|node| FITTED_TO_PARTS.contains(&node.pass.name));
        if let Some(node) = fits {
            let why = format!("{} ({}) fits its maps to the view-samples it is given", node.id, node.pass.name);
            return Ok(not_applicable(&why));
        }
        let [whole, parts] = [1, count].map(|ranges| self.machine.clone().in_ranges(ranges));
        let one = Values::run(&whole, self.plans.kept, self.job, &plain())?;
        let other = Values::run(&parts, self.plans.kept, self.job, &plain())?;
        let is_firm = |node: &Node| !matches!(node.pass.contract, Contract::Superset);
        Ok(compare_nodes(&one, &other, self.job, is_firm))
    }
}

fn not_applicable(why: &str) -> Verdict {
    Verdict::NotApplicable { why: why.into() }
}
