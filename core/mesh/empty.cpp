namespace oversketch {} // mesh
