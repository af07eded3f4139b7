namespace oversketch {} // warp
