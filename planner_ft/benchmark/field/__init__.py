"""Field cases: commands as operators give them, with what their plans must do and say."""
