namespace oversketch {} // document
