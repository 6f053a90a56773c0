//! What the window remembers: recent files, looks, unsaved scenes; and how a file is chosen.
