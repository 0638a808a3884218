use super::{KERNEL, kernel};
use shadowgraph_core::param::{Params, Value};

#[test]
fn an_even_kernel_is_refused_with_its_neighbours() {
    let params = |taps: u32| Params(vec![(KERNEL.name, Value::U32(taps))]);
    assert_eq!(kernel(&params(15)), Ok(15));
    let problem = kernel(&params(4)).unwrap_err();
    assert_eq!(problem.remedy.as_deref(), Some("use 3 or 5"));
}
