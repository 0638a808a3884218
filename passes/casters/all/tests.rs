use super::{PASS, cpu};
use shadowgraph_core::array::{Array, Element};
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::param::Params;

#[test]
fn every_triangle_casts() {
    for count in [0, 3] {
        let triangles = Array::zeros(Element::F32, [count, 3, 3]);
        let params = Params::default();
        let mut cx = CpuCx::new(&PASS, &params, [1, 1], vec![("triangles", &triangles)], &|_, _| {});
        cpu::run(&mut cx).unwrap();
        assert_eq!(cx.finish().0[0].1, Array::u32([count], vec![1; count]));
    }
}
