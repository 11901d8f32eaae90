// The position of the replay: a track, and a place on it from 0 to its last pose, possibly between two poses.

export class Player {
  constructor(run) {
    this.run = run;
    this.track = run.tracks[run.start.track];
    this.at = run.start.at;
    this.playing = false;
    this.speed = 20; // poses per second
    this.listeners = [];
  }

  get last() { return this.track.verdict.length - 1; }
  get index() { return Math.min(this.last, Math.round(this.at)); }

  onChange(listener) { this.listeners.push(listener); }
  tell() { for (const listener of this.listeners) listener(this); }

  jump(at) {
    this.at = Math.min(this.last, Math.max(0, at));
    this.tell();
  }

  step(by) {
    this.pause();
    this.jump(by > 0 ? Math.floor(this.at + 1e-9) + 1 : Math.ceil(this.at - 1e-9) - 1);
  }

  /** The places with interference, ascending. */
  problems() {
    if (!this.track.problems) {
      const { findings } = this.track;
      this.track.problems = [...new Set(findings
        .filter((finding) => this.run.verdicts[finding[1]].tone === "interference").map((finding) => finding[0]))]
        .sort((a, b) => a - b);
    }
    return this.track.problems;
  }

  stepToProblem(by) {
    this.pause();
    const near = 1e-4;
    const next = by > 0 ? this.problems().find((at) => at > this.at + near)
      : this.problems().findLast((at) => at < this.at - near);
    if (next !== undefined) this.jump(next);
  }

  choose(track) {
    this.track = this.run.tracks[track];
    this.jump(this.at);
  }

  play() {
    if (this.playing) return;
    this.playing = true;
    if (this.at >= this.last) this.at = 0;
    let before = performance.now();
    const frame = (now) => {
      if (!this.playing) return;
      this.at = Math.min(this.last, this.at + ((now - before) / 1000) * this.speed);
      before = now;
      if (this.at >= this.last) this.playing = false;
      this.tell();
      if (this.playing) requestAnimationFrame(frame);
    };
    this.tell();
    requestAnimationFrame(frame);
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.tell();
  }

  toggle() { if (this.playing) this.pause(); else this.play(); }
}
