"""Debug adapter: a simulation that an editor drives, by the Debug Adapter Protocol."""
