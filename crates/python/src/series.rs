//! `Series`: figures of each frame, as a table that pandas, polars and pyarrow take over without a copy.

use std::sync::Arc;

use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::{
    ArrayRef, Float64Array, RecordBatch, RecordBatchIterator, StringArray, UInt64Array,
};
use foldmotion_study::FrameFigures;
use pyo3::prelude::*;
use pyo3::types::PyCapsule;

use crate::error::failed;

/// The name that the interface gives a stream.
const STREAM: &std::ffi::CStr = c"arrow_array_stream";

/// Strain, bending, energy and separation of each frame: the columns of ``motion.csv``.
///
/// Speaks the Arrow PyCapsule interface: ``pandas.DataFrame.from_arrow(series)``, ``polars.DataFrame(series)``,
/// ``pyarrow.table(series)``.
#[pyclass(frozen, module = "foldmotion")]
pub(crate) struct Series {
    batch: RecordBatch,
}

impl Series {
    /// The table of `figures`; refuses nothing that a run makes.
    pub(crate) fn new(figures: &[FrameFigures]) -> PyResult<Self> {
        let numbers = |value: fn(&FrameFigures) -> f64| -> ArrayRef {
            Arc::new(Float64Array::from_iter_values(figures.iter().map(value)))
        };
        let known = |value: fn(&FrameFigures) -> f64| -> ArrayRef {
            let values = figures.iter().map(value);
            Arc::new(values.map(|x| x.is_finite().then_some(x)).collect::<Float64Array>())
        };
        let stages = figures.iter().map(|f| f.stage.name());
        let contacts = figures.iter().map(|f| f.contacts as u64);
        let columns: [(&str, ArrayRef, bool); 12] = [
            ("t", numbers(|f| f.time), false),
            ("stage", Arc::new(StringArray::from_iter_values(stages)), false),
            ("peak_strain", known(|f| f.peak_strain), true),
            ("mean_strain", known(|f| f.mean_strain), true),
            ("peak_facet_bending_deg", numbers(|f| f.peak_bending_deg), false),
            ("energy_bars", numbers(|f| f.energy.bars), false),
            ("energy_creases", numbers(|f| f.energy.creases), false),
            ("energy_facets", numbers(|f| f.energy.facets), false),
            ("energy_face_angles", numbers(|f| f.energy.face_angles), false),
            ("energy_contact", numbers(|f| f.contact_energy), false),
            ("contacts", Arc::new(UInt64Array::from_iter_values(contacts)), false),
            ("separation", known(|f| f.separation), true),
        ];
        let batch = RecordBatch::try_from_iter_with_nullable(columns).map_err(failed)?;
        Ok(Self { batch })
    }
}

#[pymethods]
impl Series {
    /// The names of the columns.
    #[getter]
    fn columns(&self) -> Vec<String> {
        self.batch.schema().fields().iter().map(|field| field.name().clone()).collect()
    }

    /// The table as a stream of Arrow's C interface.
    ///
    /// Parameters
    /// ----------
    /// requested_schema : capsule, optional
    ///     Not followed, as the interface allows; the consumer converts.
    ///
    /// Returns
    /// -------
    /// capsule
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        let _ = requested_schema;
        let batches = [Ok(self.batch.clone())];
        let reader = RecordBatchIterator::new(batches, self.batch.schema());
        PyCapsule::new_with_value(py, FFI_ArrowArrayStream::new(Box::new(reader)), STREAM)
    }

    fn __len__(&self) -> usize {
        self.batch.num_rows()
    }

    fn __repr__(&self) -> String {
        let (frames, columns) = (self.batch.num_rows(), self.batch.num_columns());
        format!("<foldmotion.Series {frames} frames, {columns} columns>")
    }
}
