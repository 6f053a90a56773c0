// Playback: the time shown, whether it runs, and how fast.

/** Seconds for which the first, the planar and the last state are held. */
const HOLD = 0.6;

class Player {
    constructor(motion, show) {
        Object.assign(this, { motion, show });
        this.time = motion.first;
        this.isPlaying = false;
        this.isRepeated = false;
        this.wait = 0;
    }

    /** Shows the state at `time`, or at the nearer end of the motion. */
    set(time) {
        this.time = Math.min(Math.max(Number(time) || 0, this.motion.first), this.motion.last);
        this.wait = 0;
        this.show();
    }

    play() {
        if (this.isPlaying || this.motion.last <= this.motion.first) return;
        if (this.time >= this.motion.last) this.time = this.motion.first;
        this.isPlaying = true;
        this.previous = undefined;
        this.show();
        requestAnimationFrame((now) => this.tick(now));
    }

    pause() {
        this.isPlaying = false;
        this.show();
    }

    toggle() {
        if (this.isPlaying) this.pause();
        else this.play();
    }

    tick(now) {
        if (!this.isPlaying) return;
        const seconds = Math.min((now - (this.previous ?? now)) / 1000, 0.1);
        this.previous = now;
        this.advance(seconds);
        this.show();
        if (this.isPlaying) requestAnimationFrame((next) => this.tick(next));
    }

    advance(seconds) {
        if (this.wait > 0) {
            this.wait -= seconds;
            if (this.wait <= 0 && this.time >= this.motion.last) this.time = this.motion.first;
            return;
        }
        const [unfold, fold] = this.motion.header.seconds;
        const stop = this.time < 1 ? Math.min(1, this.motion.last) : this.motion.last;
        this.time = Math.min(this.time + seconds / (this.time < 1 ? unfold : fold), stop);
        if (this.time < stop) return;
        if (stop < this.motion.last || this.isRepeated) this.wait = HOLD;
        else this.isPlaying = false;
    }
}

