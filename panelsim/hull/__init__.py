"""Hull forms, panel meshes, readers, checks and hydrostatics, all in hull axes."""
