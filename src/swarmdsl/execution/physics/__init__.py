"""Physics of robots in simulations, by MuJoCo: masses, forces and contacts."""
