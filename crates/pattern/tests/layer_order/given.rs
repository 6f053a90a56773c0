//! Orders that the file gives.

use foldmotion_pattern::{FoundLayers, LayerError};
use serde_json::json;

use crate::grids::{count, find, of_fold, strip};

#[test]
fn given_orders_leave_the_orders_that_agree_with_them() {
    let mut file = strip(&[1.0; 4], "UUU");
    assert_eq!(count(&of_fold(&file)), 16);
    // The second facet is turned, so that its front faces down.
    file["faceOrders"] = json!([[1, 0, 1], [0, 1, 1]]);
    assert_eq!(count(&of_fold(&file)), 8);
    // Facets 0 to 3 from below: 0, 1, 2, 3.
    file["faceOrders"] = json!([[1, 0, 1], [2, 1, -1], [3, 2, 1]]);
    assert_eq!(count(&of_fold(&file)), 1);
}

#[test]
fn an_order_against_a_crease_is_named_with_its_facets() {
    let mut file = strip(&[1.0; 2], "V");
    file["faceOrders"] = json!([[1, 0, -1]]);
    let error = find(&of_fold(&file)).unwrap_err();
    assert!(matches!(error, LayerError::GivenOrder { facets: [1, 0], is_above: false, .. }));
    assert!(
        error.to_string().contains("the crease between them folds to the other side"),
        "{error}"
    );
}

/// The creases put the facets in the order 1, 0, 2, or 1, 2, 0 if the file could have its way.
#[test]
fn an_order_that_no_order_agrees_with_is_named() {
    let mut file = strip(&[1.0, 1.0, 1.0, 1.0], "VMV");
    let pattern = of_fold(&file);
    assert!(count(&pattern) > 0);
    // Facets 0 and 2 both face up: 2 lies above 1, which lies above 0.
    file["faceOrders"] = json!([[2, 0, -1]]);
    let FoundLayers::None { facets, given } = find(&of_fold(&file)).unwrap().found else {
        panic!("an order was found");
    };
    assert_eq!((facets, given), (vec![0, 1, 2], vec![[0, 2]]));
}

#[test]
fn orders_of_faces_that_are_no_facets_are_not_read() {
    let mut file = strip(&[1.0; 2], "V");
    file["faceOrders"] = json!([[1, 0, 1]]);
    assert_eq!(of_fold(&file).face_orders.len(), 1);
    // A face that lists no vertex of the crease: the facets follow from the edges.
    file["faces_vertices"] = json!([[0, 2, 5, 3], [0, 2, 5, 3]]);
    assert!(of_fold(&file).face_orders.is_empty());
}
