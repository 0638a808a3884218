//! Rules of the house, as programs: who may import whom, file sizes, names, orphans, shaders, generated docs.

mod files;
mod imports;
mod shaders;

use libtest_mimic::{Failed, Trial};

/// Every rule.
pub fn trials() -> Vec<Trial> {
    vec![
        rule("imports/crates_use_only_what_they_may", imports::crates_use_only_what_they_may),
        rule("imports/no_pass_imports_another", imports::no_pass_imports_another),
        rule("imports/the_rule_can_fail", imports::the_rule_can_fail),
        rule("files/none_past_600_lines", files::none_past_600_lines),
        rule("files/no_drawers", files::no_drawers),
        rule("files/every_shader_is_used", files::every_shader_is_used),
        rule("files/every_pass_folder_is_in_the_catalogue", files::every_pass_folder_is_in_the_catalogue),
        rule("files/no_paths_of_a_machine", files::no_paths_of_a_machine),
        rule("shaders/every_recipe_validates", shaders::every_recipe_validates),
        rule("shaders/a_planted_error_is_found", shaders::a_planted_error_is_found),
    ]
}

fn rule(name: &str, check: fn() -> Vec<String>) -> Trial {
    Trial::test(format!("tidy/{name}"), move || {
        let faults = check();
        if faults.is_empty() { Ok(()) } else { Err(Failed::from(faults.join("\n"))) }
    })
}
