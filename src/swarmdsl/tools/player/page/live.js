// A run that goes on: what the server of the page has read of its trace is added.

const STAYS = "What has come stays.";
const TURNS = {
  gone: `The trace is gone. ${STAYS}`,
  ended: "The trace has ended.",
  renewed: `The trace has begun again. ${STAYS} Reload the page for the new one.`,
};

/** Add lines as they come, and tell what becomes of the trace. */
export function follow(player, told) {
  const source = new EventSource("events");
  const end = (words) => {
    source.close();
    told.textContent = words;
  };
  told.setAttribute("role", "status");
  told.textContent = "live";
  source.onmessage = ({ data }) => {
    const { members = [], machines = {}, lines = [], notes = [], turn, fleet } = JSON.parse(data);
    if (turn === "gone") told.textContent = TURNS.gone;
    else if (turn) end(TURNS[turn]);
    player.grow((recording) => {
      Object.assign(recording.machines, machines);
      for (const each of members) recording.join(each);
      for (const each of lines) recording.append(each);
      recording.notes.push(...notes);
      if (fleet) recording.fleet.now = fleet;
    });
  };
  source.onerror = () => end(`The server of this page has ended. ${STAYS}`);
}
