// Lines of a trace in words.
import { printable } from "./dom.js";

/** True for a line that says more than where robots are, and what measures have. */
export const isTold = ({ configuration, lost, property }) => (configuration ?? lost ?? property) !== undefined;

/** A line in words, without its time. */
export function words(recording, at) {
  const step = recording.step(at);
  if (step.property !== undefined) return printable(`property ${step.property}: ${step.verdict}${step.remark ? `, but ${step.remark}` : ""}`);
  if (step.lost !== undefined) {
    const { event, sender, member } = recording.value(at, "lost");
    return printable(`${event} from ${sender} to ${member} is lost on the way`);
  }
  const { event, sent = [], to = [], nobody = [] } = step;
  const fates = ["recalled", "deferred", "ignored"].filter((each) => step[each]);
  const address = (name, number) => `${name}${to[number] ? ` to ${to[number]}` : ""}${nobody.includes(name) ? " (nobody)" : ""}`;
  const done = [
    ["start", step.started],
    ["cancel", [...(step.cancelled ?? []), ...(step.withdrawn ?? []).map((each) => `send ${each}`)]],
    ["send", [...sent.map(address), ...(step.scheduled ?? []).map((each) => `${each.event} after ${each.after / 1000} s`)]],
    ["drop", step.dropped],
  ];
  const fate = fates.length ? ` (${fates.join(", ")})` : "";
  const moved = step.entered?.length || step.exited?.length ? ` \u2192 ${step.configuration.join(", ")}` : "";
  const head = `${recording.members[recording.memberAt(at)]?.name ?? ""}: ${event ?? "start"}${fate}${moved}`;
  return printable([head, ...done.flatMap(([word, names]) => (names?.length ? [`${word} ${names.join(", ")}`] : []))].join("; "));
}
