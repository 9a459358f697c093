// Run the script of the page, which is packed like its recording; the policy has its hash.
import { unpack } from "./unpack.js";

unpack(document.getElementById("script").textContent).then(
  (text) => {
    const script = document.createElement("script");
    script.textContent = text;
    document.head.append(script);
  },
  (error) => {
    const told = document.getElementById("notes");
    told.setAttribute("role", "alert");
    told.textContent = error.message;
  },
);
