"""Arrays: shapes, oracles in NumPy, no copies."""

from __future__ import annotations

import gc

import foldmotion
import numpy as np
import pytest


def address(array: np.ndarray) -> int:
    return int(array.__array_interface__["data"][0])


def test_positions_reach_numpy_without_a_copy(small: foldmotion.Result) -> None:
    first, second = small.motion.positions, small.motion.positions
    assert address(first) == address(second)
    assert np.shares_memory(first, second)
    assert not first.flags.owndata and not first.flags.writeable and first.flags.c_contiguous
    owner: object = small.motion
    assert first.base is owner
    # A slice of a frame, and the same motion by another way.
    assert address(small.motion.positions[3]) == address(first) + 3 * first.strides[0]


def test_arrays_outlive_what_they_came_from() -> None:
    from conftest import SMALL

    positions = foldmotion.Scene.from_dict(SMALL).resolve().run().motion.positions
    copy = positions.copy()
    gc.collect()
    for _ in range(20):
        np.random.default_rng(0).random(positions.size)
    assert np.array_equal(positions, copy)


def test_borrowed_arrays_cannot_be_written(small: foldmotion.Result) -> None:
    motion = small.motion
    for array in (motion.positions, motion.fold_angles, motion.strain, motion.bending):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0


def test_shapes_agree(small: foldmotion.Result) -> None:
    motion, pattern = small.motion, small.pattern
    frames, vertices = len(motion.times), len(pattern.vertices)
    edges, faces = len(pattern.edges), len(pattern.faces)
    assert motion.positions.shape == (frames, vertices, 3)
    assert motion.fold_angles.shape == (frames, edges)
    assert motion.strain.shape == motion.bending.shape == (frames, faces)
    assert small.edges.shape == (edges, 2) and small.faces.shape == (faces, 3)
    assert small.assignment.shape == (edges,) and pattern.fold_angles.shape == (edges,)
    assert pattern.face_facets.shape == (faces,)
    assert len(motion) == frames == len(small.series())
    assert motion.times[0] == 0.0 and np.all(np.diff(motion.times) > 0)


def test_fold_angles_are_those_of_the_normals(small: foldmotion.Result) -> None:
    """Twin in NumPy: the angle between the normals of the two triangles of an edge."""
    motion = small.motion
    for frame in (0, len(motion) // 2, len(motion) - 1):
        positions = motion.positions[frame]
        corners = positions[motion.faces]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        for edge, (a, b) in enumerate(motion.edges):
            sides = [f for f, face in enumerate(motion.faces) if a in face and b in face]
            angle = motion.fold_angles[frame, edge]
            if len(sides) == 1:
                assert np.isnan(angle)
            else:
                cosine = np.clip(normals[sides[0]] @ normals[sides[1]], -1.0, 1.0)
                assert abs(np.cos(np.radians(angle)) - cosine) < 1e-12


def test_strain_is_the_largest_of_the_edges(small: foldmotion.Result) -> None:
    motion = small.motion
    rest = np.linalg.norm(np.diff(motion.vertices[motion.faces[:, [0, 1, 2, 0]]], axis=1), axis=2)
    edges = np.diff(motion.positions[:, motion.faces[:, [0, 1, 2, 0]]], axis=2)
    strain = 100 * np.abs(np.linalg.norm(edges, axis=3) / rest - 1).max(axis=2)
    assert np.allclose(motion.strain, strain, rtol=0, atol=1e-11)


def test_exact_states_bound_the_motion(small: foldmotion.Result) -> None:
    study = small.scene.resolve()
    assert study.deployed is not None and study.compact is not None and study.closed_form is not None
    assert np.allclose(small.motion.positions[0], study.deployed, atol=1e-9)
    assert np.array_equal(study.start, study.deployed)
    assert np.array_equal(study.planar[:, :2], study.pattern.vertices)
    size = np.ptp(study.compact, axis=0)
    assert np.allclose(np.sort(size), np.sort(study.closed_form), atol=1e-9)


def test_the_profile_is_divided_into_equal_segments(small: foldmotion.Result) -> None:
    study = small.scene.resolve()
    points, division = study.profile_points(2001), study.division
    assert points is not None and division is not None
    assert points.shape == (2001, 2) and division.shape == (3, 2)
    lengths = np.linalg.norm(np.diff(division, axis=0), axis=1)
    assert np.allclose(lengths, lengths[0], rtol=1e-9)
    nearest = np.linalg.norm(points[:, None] - division[None], axis=2).min(axis=0)
    assert nearest.max() < 1e-2


def test_the_result_is_the_same_for_any_number_of_threads(small: foldmotion.Result) -> None:
    other = small.scene.resolve().run(threads=1)
    assert np.array_equal(other.motion.positions, small.motion.positions)
    assert other.report.engine.threads == 1
