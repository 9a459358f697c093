// Buttons that save the diagram.

import { coloured, save } from "./host.js";

/** `drawn` returns the diagram as `{ id, svg }`, `size` its width and height. */
export function saveButtons(drawn, size) {
  document.getElementById("svg").addEventListener("click", () => {
    const now = drawn();
    if (now) {
      void save(`${now.id}.svg`, asBlob(now.svg));
    }
  });
  document.getElementById("png").addEventListener("click", async () => {
    const now = drawn();
    if (!now) {
      return;
    }
    const image = new Image();
    image.src = URL.createObjectURL(asBlob(coloured(now.svg)));
    await image.decode();
    const sheet = document.createElement("canvas");
    [sheet.width, sheet.height] = size().map((each) => each * 2); // for print
    sheet.getContext("2d").drawImage(image, 0, 0, sheet.width, sheet.height);
    URL.revokeObjectURL(image.src);
    sheet.toBlob((blob) => blob && save(`${now.id}.png`, blob));
  });
}

function asBlob(svg) {
  return new Blob([svg], { type: "image/svg+xml" });
}
