use super::cpu::{check, run};
use super::{PASS, row_count};
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::param::Params;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::shared::NO_TRIANGLE;

type Inputs = Vec<(&'static str, Array)>;

fn inputs() -> Inputs {
    vec![
        ("triangles", Array::f32([2, 3, 3], vec![0.0; 18])),
        ("imported_position", Array::f32([2, 3], vec![1.0, 2.0, 3.0, f32::NAN, 0.0, 0.0])),
        ("imported_normal", Array::f32([2, 3], vec![0.0, 1.0, 0.0, f32::NAN, 0.0, 0.0])),
        ("imported_triangle", Array::u32([2], vec![1, NO_TRIANGLE])),
    ]
}

fn outputs(inputs: &Inputs) -> Result<Vec<(&'static str, Array)>, Problem> {
    let params = Params::default();
    let arrays = inputs.iter().map(|(name, array)| (*name, array)).collect();
    let mut cx = CpuCx::new(&PASS, &params, [1, 1], arrays, &|_, _| ());
    run(&mut cx).map(|()| cx.finish().0)
}

#[test]
fn rows_come_out_as_they_went_in_and_pixels_are_numbered_where_none_are_given() {
    let given = inputs();
    let out = outputs(&given).unwrap();
    let find = |name: &str| &out.iter().find(|(port, _)| *port == name).unwrap().1;
    assert_eq!(find("position").words(), given[1].1.words());
    assert_eq!(find("triangle").words(), given[3].1.words());
    assert_eq!(find("pixel").as_u32(), [0, 1]);
    let mut given = given;
    given.push(("imported_pixel", Array::u32([2], vec![7, 9])));
    let out = outputs(&given).unwrap();
    assert_eq!(out.iter().find(|(port, _)| *port == "pixel").unwrap().1.as_u32(), [7, 9]);
}

#[test]
fn a_missing_import_names_the_flag() {
    let mut given = inputs();
    given.remove(2);
    let problem = outputs(&given).unwrap_err();
    assert_eq!((problem.kind, problem.port.as_deref()), (Kind::Missing, Some("imported_normal")));
    assert!(problem.remedy.unwrap().contains("--view-samples"));
}

#[test]
fn arrays_of_different_lengths_are_refused() {
    let shape = |name: &str| Some(if name == "imported_pixel" { [3].as_slice() } else { &[2] });
    let problem = row_count(shape).unwrap_err();
    assert_eq!((problem.kind, problem.port.as_deref()), (Kind::PortMismatch, Some("imported_pixel")));
}

#[test]
fn the_first_bad_row_is_named() {
    let up = [[0.0, 1.0, 0.0]; 3];
    let bad = |positions: [[f32; 3]; 3], normals, triangles: [u32; 3]| {
        let problem = check(&positions, normals, &triangles, 5).unwrap_err();
        (problem.port.clone().unwrap(), problem.message)
    };
    let hole = [[0.0; 3], [0.0, f32::INFINITY, 0.0], [f32::NAN; 3]];
    assert_eq!(bad(hole, &up, [0, 4, 0]), ("imported_position".into(), "row 1 is not finite".into()));
    assert_eq!(
        bad([[0.0; 3]; 3], &hole, [0, NO_TRIANGLE, 0]),
        ("imported_normal".into(), "row 2 is not finite".into())
    );
    let (port, message) = bad([[0.0; 3]; 3], &up, [NO_TRIANGLE, 4, 5]);
    assert_eq!(port, "imported_triangle");
    assert!(message.starts_with("row 2 "));
}
