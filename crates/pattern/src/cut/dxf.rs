//! A page as DXF R12 (AC1009), the ASCII dialect that nearly every CAD and cutting program reads.
//!
//! Source: Autodesk, "DXF Reference", group codes of the LTYPE, LAYER and STYLE tables and of LINE and TEXT. Layers
//! CUT, MOUNTAIN, VALLEY, FACET and MARKS carry colour and linetype; the entities only name their layer. DXF's y runs
//! upwards. R12 has no word for the unit: `$INSUNITS` (millimetres), which came later, is read by most programs and
//! passed over by the others, and a comment says it. Fold angles are not carried.

use std::fmt::{Display, Write as _};

use super::text::{ascii, number};
use super::{CutPage, LineClass};

/// `$INSUNITS` of millimetres.
const MILLIMETRES: u8 = 4;

impl CutPage<'_> {
    /// The page as DXF R12, lengths in mm, y upwards from the lower edge of the page.
    pub fn dxf(&self) -> String {
        let mut dxf = Dxf::default();
        self.header(&mut dxf);
        self.tables(&mut dxf);
        dxf.open("ENTITIES");
        for line in &self.lines {
            let layer = line.class.name().to_uppercase();
            self.line(line.ends.map(|p| p.to_array()), &layer, &mut dxf);
        }
        for ends in &self.marks {
            self.line(ends.map(|p| p.to_array()), "MARKS", &mut dxf);
        }
        if let Some(label) = self.label() {
            let (corner, height) = self.label_position();
            dxf.pair(0, "TEXT");
            dxf.pair(8, "MARKS");
            dxf.point(0, [corner.x, self.size.y - corner.y]);
            dxf.pair(40, number(height));
            dxf.pair(1, ascii(&label));
        }
        dxf.close();
        dxf.pair(0, "EOF");
        dxf.text
    }

    fn header(&self, dxf: &mut Dxf) {
        let options = &self.pattern.options;
        dxf.pair(999, ascii(&options.title));
        dxf.pair(999, ascii(&format!("lengths in millimetres; {}", options.note)));
        dxf.open("HEADER");
        dxf.pair(9, "$ACADVER");
        dxf.pair(1, "AC1009");
        dxf.pair(9, "$INSUNITS");
        dxf.pair(70, MILLIMETRES);
        dxf.pair(9, "$EXTMIN");
        dxf.point(0, [0.0, 0.0]);
        dxf.pair(9, "$EXTMAX");
        dxf.point(0, self.size.to_array());
        dxf.close();
    }

    fn tables(&self, dxf: &mut Dxf) {
        let dashes = |class| self.pattern.options.dashes(class, self.pattern.row);
        let linetypes = [
            ("CONTINUOUS", Vec::new()),
            (linetype(LineClass::Mountain), dashes(LineClass::Mountain)),
            (linetype(LineClass::Valley), dashes(LineClass::Valley)),
        ];
        dxf.open("TABLES");
        dxf.table("LTYPE", linetypes.len());
        for (name, dashes) in &linetypes {
            dxf.linetype(name, dashes);
        }
        dxf.pair(0, "ENDTAB");
        // Sheets of units have no free hinges, and no layer for them.
        let has_free = self.of(LineClass::Free).next().is_some();
        let is_used = |class: &LineClass| has_free || *class != LineClass::Free;
        let classes: Vec<LineClass> = LineClass::ALL.into_iter().filter(is_used).collect();
        dxf.table("LAYER", classes.len() + 2);
        // Layer 0 must exist.
        dxf.layer("0", 7, "CONTINUOUS");
        for class in classes {
            dxf.layer(&class.name().to_uppercase(), colour(class), linetype(class));
        }
        dxf.layer("MARKS", 8, "CONTINUOUS");
        dxf.pair(0, "ENDTAB");
        dxf.table("STYLE", 1);
        dxf.text_style("STANDARD");
        dxf.pair(0, "ENDTAB");
        dxf.close();
    }

    fn line(&self, ends: [[f64; 2]; 2], layer: &str, dxf: &mut Dxf) {
        dxf.pair(0, "LINE");
        dxf.pair(8, layer);
        for (index, [x, y]) in ends.into_iter().enumerate() {
            dxf.point(index, [x, self.size.y - y]);
        }
    }
}

/// The name of the linetype of a class.
fn linetype(class: LineClass) -> &'static str {
    match class {
        LineClass::Mountain => "DASHDOT",
        LineClass::Valley => "DASHED",
        LineClass::Free | LineClass::Facet | LineClass::Cut => "CONTINUOUS",
    }
}

/// AutoCAD's colour numbers: red, blue, magenta, yellow, and 7, black on white.
fn colour(class: LineClass) -> u8 {
    match class {
        LineClass::Mountain => 1,
        LineClass::Valley => 5,
        LineClass::Free => 6,
        LineClass::Facet => 2,
        LineClass::Cut => 7,
    }
}

/// A DXF text in progress: pairs of group code and value.
#[derive(Default)]
struct Dxf {
    text: String,
}

impl Dxf {
    fn pair(&mut self, code: u16, value: impl Display) {
        let _ = writeln!(self.text, "{code}\n{value}");
    }

    /// The point `index` of an entity: codes 10, 20, 30 or 11, 21, 31.
    fn point(&mut self, index: usize, [x, y]: [f64; 2]) {
        let code = index as u16;
        self.pair(10 + code, number(x));
        self.pair(20 + code, number(y));
        self.pair(30 + code, "0");
    }

    fn open(&mut self, section: &str) {
        self.pair(0, "SECTION");
        self.pair(2, section);
    }

    fn close(&mut self) {
        self.pair(0, "ENDSEC");
    }

    fn table(&mut self, name: &str, entries: usize) {
        self.pair(0, "TABLE");
        self.pair(2, name);
        self.pair(70, entries);
    }

    /// Dashes are positive lengths, gaps negative ones.
    fn linetype(&mut self, name: &str, dashes: &[f64]) {
        self.pair(0, "LTYPE");
        self.pair(2, name);
        self.pair(70, 0);
        self.pair(3, "");
        self.pair(72, 65);
        self.pair(73, dashes.len());
        self.pair(40, number(dashes.iter().sum()));
        for (index, &length) in dashes.iter().enumerate() {
            let sign = if index.is_multiple_of(2) { 1.0 } else { -1.0 };
            self.pair(49, number(sign * length));
        }
    }

    fn layer(&mut self, name: &str, colour: u8, linetype: &str) {
        self.pair(0, "LAYER");
        self.pair(2, name);
        self.pair(70, 0);
        self.pair(62, colour);
        self.pair(6, linetype);
    }

    fn text_style(&mut self, name: &str) {
        self.pair(0, "STYLE");
        self.pair(2, name);
        self.pair(70, 0);
        self.pair(40, 0);
        self.pair(41, 1);
        self.pair(50, 0);
        self.pair(71, 0);
        self.pair(42, 1);
        self.pair(3, "txt");
        self.pair(4, "");
    }
}
