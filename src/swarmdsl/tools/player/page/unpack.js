// Unpack what the page holds: base64 of deflated text.

/** Return the text. */
export async function unpack(text) {
  if (typeof DecompressionStream === "undefined")
    throw new Error("This browser cannot unpack the recording: open the page in one of 2024 or later.");
  const packed = atob(text);
  const bytes = new Uint8Array(packed.length);
  for (let at = 0; at < packed.length; at++) bytes[at] = packed.charCodeAt(at);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).text();
}
