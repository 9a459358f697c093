"use strict";
// Play the picture of a run: it moves by itself, and this script sets its time.
(() => {
  const svg = document.querySelector("svg");
  const [controls, play, time, clock, rate] = ["controls", "play", "time", "clock", "rate"].map((id) =>
    document.getElementById(id),
  );
  const period = Number(controls.dataset.period); // seconds of the picture
  const run = Number(controls.dataset.run); // seconds of the run
  let at = 0;
  let last;
  let plays = !matchMedia("(prefers-reduced-motion: reduce)").matches;

  const written = (seconds) => {
    const whole = Math.floor(seconds);
    const two = (number) => String(number).padStart(2, "0");
    const [hours, minutes] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60];
    return `${hours ? `${hours}:${two(minutes)}` : minutes}:${two(whole % 60)}`;
  };
  const show = () => {
    // At the very end, the picture would begin again.
    svg.setCurrentTime(Math.min(at, period * 0.9999));
    time.value = String(at);
    clock.textContent = `${written((at / period) * run)} of ${written(run)}`;
  };
  const tell = () => (play.textContent = plays ? "Pause" : "Play");
  const step = (now) => {
    if (plays && last !== undefined) {
      at += ((now - last) / 1000) * Number(rate.value);
      if (at >= period) {
        at = period;
        plays = false;
        tell();
      }
      show();
    }
    last = now;
    requestAnimationFrame(step);
  };
  const toggle = () => {
    plays = !plays;
    if (plays && at >= period) at = 0;
    tell();
  };

  svg.pauseAnimations();
  controls.hidden = false;
  time.max = String(period);
  play.addEventListener("click", toggle);
  time.addEventListener("input", () => {
    at = Number(time.value);
    show();
  });
  document.addEventListener("keydown", (event) => {
    if (event.key === " " && !event.target.closest("button, select")) {
      event.preventDefault();
      toggle();
    }
  });
  tell();
  show();
  requestAnimationFrame(step);
})();
