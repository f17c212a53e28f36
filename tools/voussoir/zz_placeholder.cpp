// placeholder, removed once the room has a file
