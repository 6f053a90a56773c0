//! The numbers that steer a step.

/// Words of the shader's `Control`, in its order.
pub(super) const WORDS: usize = 16;

/// The shader's `Control`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Control {
    pub(super) dt: f32,
    pub(super) viscosity: f32,
    pub(super) damping: f32,
    pub(super) face_angle_stiffness: f32,
    pub(super) nodes: u32,
    pub(super) edges: u32,
    pub(super) faces: u32,
    pub(super) groups: u32,
    pub(super) work: f32,
    pub(super) path: f32,
    pub(super) squared_force: f32,
    pub(super) squared_speed: f32,
    pub(super) largest_squared_speed: f32,
    pub(super) longest_dt: f32,
    pub(super) longest_way: f32,
    pub(super) age: f32,
}

/// The names of the words.
#[cfg(test)]
pub(super) const NAMES: [&str; WORDS] = [
    "dt",
    "viscosity",
    "damping",
    "face_angle_stiffness",
    "nodes",
    "edges",
    "faces",
    "groups",
    "work",
    "path",
    "squared_force",
    "squared_speed",
    "largest_squared_speed",
    "longest_dt",
    "longest_way",
    "age",
];

impl Control {
    pub(super) fn to_words(self) -> [u32; WORDS] {
        [
            self.dt.to_bits(),
            self.viscosity.to_bits(),
            self.damping.to_bits(),
            self.face_angle_stiffness.to_bits(),
            self.nodes,
            self.edges,
            self.faces,
            self.groups,
            self.work.to_bits(),
            self.path.to_bits(),
            self.squared_force.to_bits(),
            self.squared_speed.to_bits(),
            self.largest_squared_speed.to_bits(),
            self.longest_dt.to_bits(),
            self.longest_way.to_bits(),
            self.age.to_bits(),
        ]
    }

    pub(super) fn from_words(words: &[u32; WORDS]) -> Self {
        let number = |index: usize| f32::from_bits(words[index]);
        Self {
            dt: number(0),
            viscosity: number(1),
            damping: number(2),
            face_angle_stiffness: number(3),
            nodes: words[4],
            edges: words[5],
            faces: words[6],
            groups: words[7],
            work: number(8),
            path: number(9),
            squared_force: number(10),
            squared_speed: number(11),
            largest_squared_speed: number(12),
            longest_dt: number(13),
            longest_way: number(14),
            age: number(15),
        }
    }
}
