// The theme chosen last, set before anything is drawn: no flash of a bright page at night. A classic script, because modules wait for the document.
(() => {
  try {
    const theme = localStorage.getItem("theme");
    if (["light", "sunlight", "night"].includes(theme)) document.documentElement.dataset.theme = theme;
  } catch {
    // Storage is switched off: the system's theme it is.
  }
})();
