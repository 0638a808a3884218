use super::*;
use shadowgraph_core::param::Params;
use shadowgraph_core::pass::{Contract, Pass};
use shadowgraph_core::record::{Command, DeviceLimits, Dispatch, Groups};
use shadowgraph_core::stage::Stage;

static NOTHING: Stage = Stage { name: "nothing", doc: "Has no ports.", ports: &[] };
static NO_PASS: Pass = Pass {
    name: "no_pass",
    stage: &NOTHING,
    doc: "Owns the recorded scan.",
    source: "none",
    ignores: &[],
    params: &[],
    counters: &[],
    contract: Contract::Exact,
    features: &[],
    size: |_| Vec::new(),
    cpu: None,
    gpu: None,
};

fn dispatches(count: usize) -> Vec<Dispatch> {
    let limits = DeviceLimits { storage_binding_bytes: 1 << 27, texture_side: 8192, storage_buffers: 8 };
    let params = Params::default();
    let mut cx = GpuCx::new(&NO_PASS, &params, [1, 1], Vec::new(), limits);
    record_scan(&mut cx, Target::Port("lengths"), count, Target::Port("offsets"));
    let commands = cx.finish().1.into_iter();
    commands
        .map(|command| match command {
            Command::Dispatch(dispatch) => dispatch,
            other => panic!("{other:?}"),
        })
        .collect()
}

fn entries(count: usize) -> Vec<&'static str> {
    dispatches(count).iter().map(|dispatch| dispatch.entry).collect()
}

#[test]
fn levels_are_added_only_when_the_workgroup_at_the_top_is_full() {
    for count in [0, 1, 257, TOP] {
        assert_eq!(entries(count), ["scan_top"], "{count}");
    }
    for count in [TOP + 1, TOP * RUN] {
        assert_eq!(entries(count), ["scan_sum", "scan_top", "scan_add"], "{count}");
    }
    assert_eq!(entries(TOP * RUN + 1), ["scan_sum", "scan_sum", "scan_top", "scan_add", "scan_add"]);
}

#[test]
fn every_entry_has_an_invocation() {
    for count in [TOP + 1, 1 << 18, (1 << 24) + 1] {
        let Groups::Direct([x, y, z]) = dispatches(count)[0].groups else { panic!("indirect") };
        assert!(x as usize * y as usize * z as usize * 64 * RUN >= count, "{count}");
    }
}

#[test]
fn the_constants_of_the_kernel_are_those_of_the_recipe() {
    assert!(include_str!("scan.wgsl").contains(&format!("const TOP_GROUP: u32 = {TOP_GROUP}u;")));
}

#[test]
fn sums_counted_by_hand() {
    assert_eq!(exclusive(&[]).unwrap(), [0]);
    assert_eq!(exclusive(&[7]).unwrap(), [0, 7]);
    assert_eq!(exclusive(&[3, 0, 2, 5]).unwrap(), [0, 3, 3, 5, 10]);
}

#[test]
fn chunks_continue_one_another() {
    for count in [CHUNK - 1, CHUNK, CHUNK + 1, 3 * CHUNK + 7] {
        let lengths: Vec<u32> = (0..count as u32).map(|i| i.wrapping_mul(2_654_435_761) >> 28).collect();
        let offsets = exclusive(&lengths).unwrap();
        assert_eq!(offsets[0], 0);
        let steps: Vec<u32> = offsets.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert!(steps == lengths, "{count}");
    }
}

#[test]
fn a_total_past_32_bits_is_an_error_not_a_wrap() {
    assert_eq!(exclusive(&[u32::MAX, 0]).unwrap()[2], u32::MAX);
    let problem = exclusive(&[u32::MAX, 1]).unwrap_err();
    assert_eq!((problem.kind, problem.found.as_deref()), (Kind::Overflow, Some("4294967296")));
}
