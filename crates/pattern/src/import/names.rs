//! The names by which a drawing calls its lines.

/// The most names of each kind that an element keeps.
const MOST_NAMES: usize = 64;
/// The most letters of a name.
const LONGEST_NAME: usize = 200;

/// The names of an element of a drawing: its own and those of the groups around it.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Names {
    /// Ids of SVG, names of objects and groups of OBJ.
    pub ids: Vec<String>,
    /// Classes of SVG, layers of DXF, materials of OBJ.
    pub classes: Vec<String>,
}

impl Names {
    pub(super) fn add_id(&mut self, id: &str) {
        add(&mut self.ids, id);
    }

    pub(super) fn add_class(&mut self, class: &str) {
        add(&mut self.classes, class);
    }
}

fn add(list: &mut Vec<String>, name: &str) {
    let name: String = name.chars().take(LONGEST_NAME).collect();
    if !name.is_empty() && list.len() < MOST_NAMES && !list.contains(&name) {
        list.push(name);
    }
}
