namespace oversketch {} // deform
