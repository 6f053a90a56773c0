//! The parts of the paper.

use crate::PaperError;

/// A part of the paper.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PaperPart {
    /// Table 1: the division of the nine profiles.
    Table1,
    /// Table 2: rows and columns.
    Table2,
    /// Figure 1 to 10, by its number.
    Figure(u8),
    /// All nine profiles unfolded into the plane, with certificates.
    Unfoldings,
    /// The compact boxes of nine profiles in four cases, simulated without contact.
    Cases,
    /// Motions with contact of the profiles of figure A1 in four cases, with certificates.
    Certificates,
    /// Figure A1, drawn from those motions.
    FigureA1,
}

impl PaperPart {
    /// All parts, in the order in which they are computed.
    pub const ALL: [Self; 16] = [
        Self::Table1,
        Self::Table2,
        Self::Figure(1),
        Self::Figure(2),
        Self::Figure(3),
        Self::Figure(4),
        Self::Figure(5),
        Self::Figure(6),
        Self::Figure(7),
        Self::Figure(8),
        Self::Figure(9),
        Self::Figure(10),
        Self::Unfoldings,
        Self::Cases,
        Self::Certificates,
        Self::FigureA1,
    ];

    /// The name on the command line and in file names.
    pub fn name(self) -> &'static str {
        match self {
            Self::Table1 => "table1",
            Self::Table2 => "table2",
            Self::Figure(1) => "fig1",
            Self::Figure(2) => "fig2",
            Self::Figure(3) => "fig3",
            Self::Figure(4) => "fig4",
            Self::Figure(5) => "fig5",
            Self::Figure(6) => "fig6",
            Self::Figure(7) => "fig7",
            Self::Figure(8) => "fig8",
            Self::Figure(9) => "fig9",
            Self::Figure(_) => "fig10",
            Self::Unfoldings => "unfoldings",
            Self::Cases => "cases",
            Self::Certificates => "certificates",
            Self::FigureA1 => "figA1",
        }
    }

    /// The parts of a list such as `table1,figA1` in any case, in the order in which they are computed, each once.
    ///
    /// # Errors
    /// [`PaperError::Part`] of the first unknown name.
    pub fn parse_list(list: &str) -> Result<Vec<Self>, PaperError> {
        let find = |name: &str| {
            let mut parts = Self::ALL.into_iter();
            let found = parts.find(|part| part.name().eq_ignore_ascii_case(name.trim()));
            found.ok_or_else(|| PaperError::Part {
                name: name.trim().to_owned(),
                known: Self::ALL.map(Self::name).join(", "),
            })
        };
        let requested: Vec<Self> = list.split(',').map(find).collect::<Result<_, _>>()?;
        Ok(Self::ALL.into_iter().filter(|part| requested.contains(part)).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_is_found_by_its_name_and_lists_are_put_in_order() {
        let all = PaperPart::ALL.map(PaperPart::name).join(",");
        assert_eq!(PaperPart::parse_list(&all).unwrap(), PaperPart::ALL);
        let two = PaperPart::parse_list("figa1, table1,figA1").unwrap();
        assert_eq!(two, [PaperPart::Table1, PaperPart::FigureA1]);
    }

    #[test]
    fn an_unknown_part_is_refused_with_the_list_of_those_there_are() {
        for list in ["", "fig11", "table1,,fig1", "figure1"] {
            let error = PaperPart::parse_list(list).unwrap_err();
            assert_eq!(error.status(), 2);
            assert!(error.to_string().contains("table1, table2, fig1"), "{error}");
        }
    }
}
