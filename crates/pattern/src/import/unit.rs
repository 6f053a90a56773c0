//! Units of length, as FOLD names them.

/// The unit of length of a pattern (`frame_unit` of FOLD 1.2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum LengthUnit {
    /// No physical length.
    #[default]
    Unit,
    /// 25.4 mm.
    Inch,
    /// 1/72 inch.
    Point,
    /// 1 m.
    Metre,
    /// 0.01 m.
    Centimetre,
    /// 0.001 m.
    Millimetre,
    /// 1e-6 m.
    Micrometre,
    /// 1e-9 m.
    Nanometre,
}

impl LengthUnit {
    const ALL: [(Self, &'static str, Option<f64>); 8] = [
        (Self::Unit, "unit", None),
        (Self::Inch, "in", Some(0.0254)),
        (Self::Point, "pt", Some(0.0254 / 72.0)),
        (Self::Metre, "m", Some(1.0)),
        (Self::Centimetre, "cm", Some(0.01)),
        (Self::Millimetre, "mm", Some(0.001)),
        (Self::Micrometre, "um", Some(1e-6)),
        (Self::Nanometre, "nm", Some(1e-9)),
    ];

    fn entry(self) -> (Self, &'static str, Option<f64>) {
        let found = Self::ALL.into_iter().find(|(unit, ..)| *unit == self);
        found.unwrap_or(Self::ALL[0])
    }

    /// Its name in FOLD.
    pub fn name(self) -> &'static str {
        self.entry().1
    }

    /// Its length in metres; `None` if it has no physical length.
    pub fn metres(self) -> Option<f64> {
        self.entry().2
    }

    /// The unit that FOLD calls `name`.
    pub fn named(name: &str) -> Option<Self> {
        let found = Self::ALL.into_iter().find(|(_, known, _)| *known == name);
        found.map(|(unit, ..)| unit)
    }
}
