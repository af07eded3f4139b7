namespace oversketch {} // geometry
