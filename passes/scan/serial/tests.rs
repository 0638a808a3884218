use super::PASS;
use super::cpu::running_sum;
use super::gpu::{LINK, MOST};
use crate::ports;
use shadowgraph_core::param::Params;
use shadowgraph_core::problem::Kind;
use shadowgraph_core::record::{Bind, Command, DeviceLimits, GpuCx};
use shadowgraph_core::shared::LOOP_STEPS;

#[test]
fn sums_counted_by_hand() {
    assert_eq!(running_sum(&[]).unwrap(), [0]);
    assert_eq!(running_sum(&[5]).unwrap(), [0, 5]);
    assert_eq!(running_sum(&[3, 0, 2, 5]).unwrap(), [0, 3, 3, 5, 10]);
}

#[test]
fn a_total_past_32_bits_is_an_error_not_a_wrap() {
    assert_eq!(running_sum(&[u32::MAX - 1, 1]).unwrap()[2], u32::MAX);
    assert_eq!(running_sum(&[u32::MAX, 1]).unwrap_err().kind, Kind::Overflow);
}

/// First and end of every link of the chain over `count` cells.
fn links(count: usize) -> Result<Vec<Vec<u32>>, Kind> {
    let shapes = vec![(ports::LENGTH.name, vec![1, 1, count]), (ports::OFFSET.name, vec![count + 1])];
    let limits = DeviceLimits { storage_binding_bytes: 1 << 27, texture_side: 8192, storage_buffers: 8 };
    let params = Params::default();
    let mut cx = GpuCx::new(&PASS, &params, [1, 1], shapes, limits);
    super::gpu::record(&mut cx).map_err(|problem| problem.kind)?;
    let uniform = |command: Command| match command {
        Command::Dispatch(dispatch) => match &dispatch.bind[0] {
            Bind::Uniform(words) => words.clone(),
            other => panic!("{other:?}"),
        },
        other => panic!("{other:?}"),
    };
    Ok(cx.finish().1.into_iter().map(uniform).collect())
}

#[test]
fn the_chain_meets_every_cell_once_within_the_steps_of_an_invocation() {
    assert_eq!(links(0), Ok(vec![vec![0, 0]]));
    for count in [1, LINK, LINK + 1, 5 * LINK + 3] {
        let chain = links(count).unwrap();
        assert_eq!((chain[0][0], chain[chain.len() - 1][1]), (0, count as u32));
        assert!(chain.windows(2).all(|pair| pair[0][1] == pair[1][0]));
        assert!(chain.iter().all(|link| ((link[1] - link[0]) as usize) < LOOP_STEPS));
    }
}

#[test]
fn too_long_a_chain_is_refused() {
    assert!(links(MOST).is_ok());
    assert_eq!(links(MOST + 1), Err(Kind::Unsupported));
}
