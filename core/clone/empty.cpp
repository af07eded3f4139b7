namespace oversketch {} // clone
