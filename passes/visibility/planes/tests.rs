use super::PASS;
use crate::shared::hard_scenes::{Case, Inputs, output, random, run, scan};
use shadowgraph_core::array::Array;

/// The inputs of `case` with a caster table that lists, in every cell, all casters that block one of its view-samples, in
/// triangle order, and every `more`-th other triangle.
fn with_table(case: &Case, more: usize) -> Inputs {
    let mut inputs = case.inputs();
    let cells = output(&inputs, "list_length").words().len();
    let cell = output(&inputs, "cell").as_u32().to_vec();
    let mut table = vec![Vec::new(); cells];
    for (at, list) in table.iter_mut().enumerate() {
        let here: Vec<usize> = (0..cell.len()).filter(|sample| cell[*sample] == at as u32).collect();
        for caster in 0..case.triangles.len() {
            if caster % more == 0 && case.casts[caster] != 0 || here.iter().any(|sample| case.blocks(*sample, caster)) {
                list.push(caster as u32);
            }
        }
    }
    let lengths: Vec<u32> = table.iter().map(|list| list.len() as u32).collect();
    inputs.push(("caster_offset", Array::u32([cells + 1], scan(&lengths))));
    let entries = table.concat();
    inputs.push(("caster_entries", Array::u32([entries.len()], entries)));
    inputs
}

#[test]
fn random_scenes_have_no_wrong_bit() {
    for seed in 0..150 {
        let case = random(seed, 6 + 12 * (seed % 4) as usize, 200);
        let (outputs, _) = run(&PASS, &with_table(&case, 1 + seed as usize % 5)).unwrap();
        assert_eq!(output(&outputs, "mask").as_u32(), case.mask(), "seed {seed}");
    }
}

#[test]
fn long_lists_have_no_wrong_bit() {
    for seed in 0..12 {
        let mut case = random(2000 + seed, 20, 3000);
        case.side = 1;
        let (outputs, _) = run(&PASS, &with_table(&case, 1)).unwrap();
        assert_eq!(output(&outputs, "mask").as_u32(), case.mask(), "seed {seed}");
    }
}

#[test]
fn only_listed_casters_count() {
    let case = random(3, 20, 200);
    let mut inputs = with_table(&case, 1);
    for (port, array) in &mut inputs {
        if *port == "caster_offset" {
            array.words_mut().fill(0);
        }
    }
    let (outputs, _) = run(&PASS, &inputs).unwrap();
    let expected: Vec<u32> = case.mask().iter().map(|word| if *word == 1 { 0 } else { *word }).collect();
    assert!(case.mask().contains(&1));
    assert_eq!(output(&outputs, "mask").as_u32(), expected);
}

#[test]
fn more_than_one_light_sample_is_refused() {
    let case = random(1, 4, 10);
    let mut inputs = with_table(&case, 1);
    for (port, array) in &mut inputs {
        if *port == "light_samples" {
            *array = Array::f32([2, 3], vec![0.0; 6]);
        }
    }
    let problem = run(&PASS, &inputs).unwrap_err();
    assert_eq!(problem.port.as_deref(), Some("light_samples"));
    assert!(problem.to_string().contains("found 2 light samples"), "{problem}");
}
