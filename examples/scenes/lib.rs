//! Scenes as plain data: glTF 2.0 files, views files, procedural scenes.
