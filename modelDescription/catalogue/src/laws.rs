//! The table of the laws in docs/controllers.md, made from the table that computes with them.

use admittance::Law;
use admittance::law::{Felt, Yields};

/// The table, as it stands there between its marks.
pub fn table() -> String {
    let mut lines = vec![
        "| `law` | name | what it is | the nominal feels | spring | tank | forms |".to_owned(),
        "|---|---|---|---|---|---|---|".to_owned(),
    ];
    for law in Law::ALL {
        let row = law.row();
        let felt = match row.felt {
            Felt::Nothing => "nothing",
            Felt::Coupling => "the whole coupling",
            Felt::Delivered => "the force that the robot gets",
        };
        let spring = match row.spring {
            Yields::Never => "free",
            Yields::Force => "limited",
            Yields::Slips => "slips at the limit",
        };
        let tank = match (row.offered, row.keeps_tank) {
            (false, _) => "–",
            (true, false) => "observed",
            (true, true) => "kept ≥ 0",
        };
        let forms = match (row.offered, row.servo) {
            (false, _) => "testbed",
            (true, false) => "testbed; arm",
            (true, true) => "testbed, also as a drive's command; arm",
        };
        lines.push(format!(
            "| {} | `{}` | {} | {felt} | {spring} | {tank} | {forms} |",
            law.number(),
            law.name(),
            row.text
        ));
    }
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_readme_has_the_table_of_the_laws() {
        let readme =
            std::fs::read_to_string(crate::root().join("docs/controllers.md")).expect("is there");
        let begin = "<!-- laws: made from fmu/admittance/src/law.rs -->\n";
        let block = readme
            .split_once(begin)
            .and_then(|(_, rest)| rest.split_once("\n<!-- end -->"))
            .map(|(block, _)| block);
        assert!(
            block == Some(&table()),
            "expected in docs/controllers.md:\n{}",
            table()
        );
    }
}
