"""Many candidates on several data sets with one command, a process each, resumed after a kill."""
