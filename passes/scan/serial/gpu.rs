//! A chain of dispatches of one invocation each.

use crate::ports;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::Bind::{Read, ReadWrite, Uniform};
use shadowgraph_core::record::{GpuCx, Target::Port};

/// Entries of one dispatch: below the loop steps an invocation may take.
pub const LINK: usize = 1 << 14;
/// Most entries: a chain of 1,024 links.
pub const MOST: usize = LINK << 10;

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let count = cx.words(ports::LENGTH.name);
    if count > MOST {
        return Err(Problem::new(Kind::Unsupported, "too many cells for one invocation")
            .port(ports::LENGTH.name)
            .expected(format!("at most {MOST}"))
            .found(count.to_string())
            .remedy("use scan/work_efficient"));
    }
    // No cells still have a total.
    for first in (0..count.max(1)).step_by(LINK) {
        let end = count.min(first + LINK);
        let bind = vec![
            Uniform(vec![first as u32, end as u32]),
            Read(Port(ports::LENGTH.name)),
            ReadWrite(Port(ports::OFFSET.name)),
        ];
        cx.dispatch("scan/serial", &[include_str!("kernel.wgsl")], "serial", bind, 1, 1);
    }
    Ok(())
}
