"""Roll damping of viscosity and lift: polynomial terms, Ikeda's components, fits of decay tests."""
