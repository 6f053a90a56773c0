//! The sheet in space: camera, drawing on the GPU, picking.
