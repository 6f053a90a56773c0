//! The names of facets and their units.

use foldmotion_pattern::{Facet, UnitSheet};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::subject::Subject;

/// A unit by row, column and the paper's name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct UnitName {
    /// The row of the unit, counted from 0.
    pub row: u32,
    /// The column of the unit, counted from 0.
    pub column: u32,
    /// The paper's name of the unit: U^O or U^E.
    pub name: String,
}

impl Subject {
    /// The name of a facet: its kind, index and unit.
    pub(crate) fn facet_name(&self, facet: u32) -> String {
        let Some(units) = self.units() else {
            return format!("facet {facet}");
        };
        let Facet { row, column, kind, .. } = units.units.sheet.facets[facet as usize];
        let unit = UnitSheet::unit_name(row);
        format!("{} {facet} of unit {unit} row {row} column {column}", kind.name())
    }

    /// The units of two facets; `None` for an imported pattern.
    pub(crate) fn units_of(&self, facets: [u32; 2]) -> Option<[UnitName; 2]> {
        let sheet = &self.units()?.units.sheet;
        Some(facets.map(|facet| {
            let facet = &sheet.facets[facet as usize];
            UnitName {
                row: facet.row,
                column: facet.column,
                name: UnitSheet::unit_name(facet.row).to_owned(),
            }
        }))
    }
}
