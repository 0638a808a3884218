use super::{IMAGE_TEXTURE, PASS, cpu::run};
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::param::Params;

#[test]
fn the_texture_holds_the_picture() {
    let params = Params::default();
    let image = Array::f32([1, 2, 4], vec![1.0, 0.5, -0.0, 1.0, 2.0, 3.0, f32::INFINITY, 0.0]);
    let mut cx = CpuCx::new(&PASS, &params, [2, 1], vec![("image", &image)], &|_, _| ());
    run(&mut cx).unwrap();
    let (outputs, _) = cx.finish();
    assert_eq!(outputs, [(IMAGE_TEXTURE, image.clone())]);
}
