namespace oversketch {} // session
