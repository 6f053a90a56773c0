"""A certified shelter with its film, and where its sheet is strained most: an example that mypy --strict accepts."""

from __future__ import annotations

import sys
from pathlib import Path

import foldmotion
import numpy as np
from numpy.typing import NDArray


def report(phase: str, done: float) -> None:
    """Show progress."""
    print(f"\r{phase} {done:4.0%}", end="", file=sys.stderr)


def centres(motion: foldmotion.Motion) -> NDArray[np.float64]:
    """Return the centre of each triangle in each frame, (frames, faces, 3)."""
    mean: NDArray[np.float64] = motion.positions[:, motion.faces].mean(axis=2)
    return mean


def main(scene_file: Path, folder: Path) -> int:
    """Fold the scene, prove and verify its motion, and write its results."""
    try:
        study = foldmotion.Scene.from_file(scene_file).resolve()
    except foldmotion.BadInput as error:
        print(error, file=sys.stderr)
        return error.status
    result = study.run(progress=report)
    verified = foldmotion.verify(result, result.certificate)
    frame, face = np.unravel_index(result.motion.strain.argmax(), result.motion.strain.shape)
    print(f"\n{result.line}\n{verified.line}")
    print(f"largest strain {result.motion.strain.max():.3f} % at t = {result.motion.times[frame]:.3f}")
    print("of the triangle at", centres(result.motion)[frame, face])
    result.save(folder)
    result.write_mp4(folder / "film.mp4", size=(480, 360), caption=True)
    return result.status


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2])))
