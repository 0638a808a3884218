//! What kernels and CPU functions count is what their values say.

use crate::bench::{job, render_args};
use crate::gpu;
use libtest_mimic::{Failed, Trial};
use shadowgraph::args::BackendChoice;
use shadowgraph::engine::Machine;
use shadowgraph::graph_choice;
use shadowgraph::outcome::Outcome;
use shadowgraph_core::plan::Plan;
use shadowgraph_core::shared::KEPT;
use shadowgraph_graph::Keep;

/// On both backends.
pub fn trials() -> Vec<Trial> {
    let mut trials = Vec::new();
    for lists in ["atomic_counters", "sort"] {
        for visibility in ["planes", "fused"] {
            let name = |backend: &str| format!("counters/{lists}/{visibility}/{backend}");
            let run = move |choice| right(choice, lists, visibility);
            trials.push(Trial::test(name("cpu"), move || run(BackendChoice::Cpu)));
            trials.push(gpu::trial(name("wgpu"), move |_| run(BackendChoice::Wgpu)));
        }
    }
    trials.push(Trial::test("counters/of_ranges_are_added_and_of_largest_the_largest_is_taken", in_ranges));
    trials
}

fn run(choice: BackendChoice, words: &[&str], ranges: u32) -> Result<(Plan, Outcome), Failed> {
    let job = job("builtin:columns", "90x70");
    let machine = Machine::new(choice).map_err(|problem| problem.to_string())?.in_ranges(ranges);
    let graph = render_args(&[&["hard"], words].concat()).graph;
    let catalogue = shadowgraph_passes::catalogue();
    let plan = graph_choice::plan(&graph, &catalogue, Some(&job.facts), machine.default_backend, Keep::AllLivePorts)
        .map_err(|problems| problems.to_string())?;
    let outcome = machine.run(&plan, &job, 1, &|_, _, _| {}).map_err(|problem| problem.to_string())?;
    Ok((plan, outcome))
}

fn count(outcome: &Outcome, node: &str, name: &str) -> Option<u64> {
    let record = outcome.nodes.iter().find(|record| record.node == node)?;
    record.counts.iter().find(|(counter, _)| *counter == name).map(|(_, count)| *count)
}

fn right(choice: BackendChoice, lists: &str, visibility: &str) -> Result<(), Failed> {
    let swaps = [format!("list_build={lists}"), format!("visibility={visibility}")];
    let words = ["--swap", &swaps[0], "--swap", &swaps[1], "--swap", "casters=light_back_facing"];
    let (plan, outcome) = run(choice, &words, 1)?;
    let words_of = |slot: &str| plan.slot(slot).map(|slot| outcome.values.get(slot).words()).unwrap_or_default();
    let longest = words_of("list_build.list_length").iter().max().map(|length| u64::from(*length));
    assert!(longest > Some(1), "{longest:?}");
    assert_eq!(count(&outcome, "list_build", "longest_list"), longest);
    let culled = words_of("casters.caster_state").iter().filter(|state| **state == 0).count() as u64;
    assert!(culled > 0);
    assert_eq!(count(&outcome, "casters", "culled"), Some(culled));
    let [tested, blocking] = ["pairs", "blocking_pairs"].map(|name| count(&outcome, "visibility", name));
    if matches!(choice, BackendChoice::Wgpu) {
        assert_eq!((tested, blocking), (None, None), "a kernel shows what it does not count");
        return Ok(());
    }
    let kept = words_of("sample_filter.sample_state").iter().zip(words_of("visibility.mask"));
    let blocked = kept.filter(|(state, mask)| **state == KEPT && **mask == 1).count() as u64;
    assert!(blocked > 0);
    assert_eq!(blocking, Some(blocked), "each view-sample in shadow was put there by one pair");
    assert!(tested > blocking, "{tested:?} {blocking:?}");
    Ok(())
}

fn in_ranges() -> Result<(), Failed> {
    let [whole, parts] = [1, 3].map(|ranges| run(BackendChoice::Cpu, &[], ranges));
    let ((_, whole), (_, parts)) = (whole?, parts?);
    let of = |outcome: &Outcome| {
        let count = |node, name| count(outcome, node, name).unwrap_or(0);
        (count("list_build", "longest_list"), count("visibility", "blocking_pairs"))
    };
    let ((longest, blocking), (longest_part, blocking_parts)) = (of(&whole), of(&parts));
    assert!(longest_part <= longest && longest_part * 3 >= longest, "{longest_part} {longest}");
    assert_eq!(blocking, blocking_parts);
    Ok(())
}
