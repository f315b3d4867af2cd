// The moment shown. A moment is a frame and a fraction of the way to the next one.

/** Plays a run; notifies its listeners when the moment or the playback state changes. */
export class Player extends EventTarget {
    constructor(run) {
        super();
        this.run = run;
        this.frame = 0;
        this.fraction = 0;
        this.time = run.start;
        this.isPlaying = false;
        this.isLooping = false;
        this.speed = 1;
    }

    /** Shows a time between frames. */
    seek(time) {
        const { run } = this;
        this.time = Math.min(Math.max(time, run.start), run.end);
        this.frame = run.frameAt(this.time);
        const span = this.frame + 1 < run.frameCount ? run.times[this.frame + 1] - run.times[this.frame] : 0;
        // No interpolation where frames were lost.
        this.fraction = span > 0 && !run.isGapAfter(this.frame) ? (this.time - run.times[this.frame]) / span : 0;
        this.dispatchEvent(new Event("moment"));
    }

    /** Shows a frame exactly. */
    seekFrame(frame) {
        this.seek(this.run.times[Math.min(Math.max(Math.round(frame), 0), this.run.frameCount - 1)]);
    }

    /** Goes some frames on, or back. */
    step(frames) {
        this.pause();
        const from = frames < 0 && this.fraction > 0 ? this.frame + 1 : this.frame;
        this.seekFrame(from + frames);
    }

    /** Goes to the next frame, or the one before, in which the number of contacts is another. */
    stepToChange(direction) {
        this.pause();
        const { run } = this;
        let frame = this.frame;
        const here = run.contactCount(frame);
        while (frame + direction >= 0 && frame + direction < run.frameCount) {
            frame += direction;
            if (run.contactCount(frame) !== here) break;
        }
        this.seekFrame(frame);
    }

    play() {
        if (this.run.frameCount < 2) return;
        if (this.time >= this.run.end) this.seek(this.run.start);
        this.isPlaying = true;
        this.dispatchEvent(new Event("manner"));
    }

    pause() {
        if (!this.isPlaying) return;
        this.isPlaying = false;
        this.dispatchEvent(new Event("manner"));
    }

    toggle() {
        if (this.isPlaying) this.pause();
        else this.play();
    }

    setSpeed(speed) {
        this.speed = speed;
        this.dispatchEvent(new Event("manner"));
    }

    /** Advances by some seconds of wall-clock time. */
    advance(seconds) {
        const time = this.time + seconds * this.speed;
        if (time < this.run.end) {
            this.seek(time);
        } else if (this.isLooping) {
            this.seek(this.run.start);
        } else {
            this.seek(this.run.end);
            this.pause();
        }
    }
}
