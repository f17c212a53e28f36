"""The state at an instant."""


def rotation_matrix(quaternion):
    """The matrix, shape (3, 3), of a unit quaternion (w, x, y, z)."""
    import numpy as np
    w, x, y, z = quaternion
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


class Snapshot:
    """The state at an instant, in the assembly's order.

    time               s
    base_displacement  of the ground, shape (3,), m
    displacement       of each block's centroid since the assembly, shape (n, 3), m
    rotation           of each block since the assembly, unit quaternions (w, x, y, z), shape (n, 4)
    velocity           of each block's centroid, shape (n, 3), m/s
    joints             dictionary of arrays over the assembly's joints and then the contacts found during the run:
                       a, b (blocks), area (m2), centroid (m) and normal (unit vector from a to b), shape (j, 3) each,
                       opening, slip (m), largest_opening, largest_slip (m, since the start), normal_traction (Pa,
                       tension positive), shear_traction (Pa), eccentricity (share of the depth), utilisation (shear
                       over shear capacity), bonded (share of the area), had_bond (the joint is elastic or had a bond at
                       the start), tie (it is a tie)
    joint_count        how many of them are joints of the assembly
    fill_displacement  of each node of the fill, shape (k, 3), m
    """

    def __init__(self, values):
        self.time = values["time"]
        self.base_displacement = values["base_displacement"]
        self.displacement = values["displacement"]
        self.rotation = values["rotation"]
        self.velocity = values["velocity"]
        self.joints = values["joints"]
        self.joint_count = values["joint_count"]
        self.fill_displacement = values["fill_displacement"]

    def vertices(self, assembly, block, amplification=1.0):
        """Corners of a block where it is now: [array of shape (v, 3) in m for each convex cell].

        amplification multiplies the displacement and, to first order, the rotation.
        """
        centre = assembly.centroids[block]
        turn = rotation_matrix(self.rotation[block])
        moved = [(corners - centre) @ turn.T + centre + self.displacement[block]
                 for corners, _ in assembly.block(block)]
        if amplification == 1.0:
            return moved
        return [corners + amplification * (to - corners)
                for (corners, _), to in zip(assembly.block(block), moved)]

    def __repr__(self):
        return f"<voussoir.Snapshot at {self.time:g} s of {len(self.displacement)} blocks>"
