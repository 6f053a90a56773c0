// The view of the sheet: canvas, camera and pointer.

const MARGIN = 1.1;

/** The diagonal of the box around all points. */
function reach(points) {
    const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
    points.forEach((x, i) => {
        low[i % 3] = Math.min(low[i % 3], x);
        high[i % 3] = Math.max(high[i % 3], x);
    });
    return Math.hypot(...low.map((x, k) => high[k] - x)) || 1;
}

class Stage {
    constructor(motion, paper, canvas) {
        Object.assign(this, { motion, paper, canvas });
        this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
        this.renderer.setClearColor(0xffffff, 0);
        this.scene = new THREE.Scene().add(paper.mesh);
        this.camera = new THREE.OrthographicCamera();
        this.camera.up.set(0, 0, 1);
        this.controls = new THREE.OrbitControls(this.camera, canvas);
        this.controls.enableDamping = false;
        this.controls.enableZoom = false;
        this.controls.addEventListener("change", () => this.request());
        // The wheel scrolls the page until the picture was pressed.
        canvas.addEventListener("pointerdown", () => canvas.focus({ preventScroll: true }));
        canvas.addEventListener("focus", () => { this.controls.enableZoom = true; });
        canvas.addEventListener("blur", () => { this.controls.enableZoom = false; });
        this.caster = new THREE.Raycaster();
        this.isWaiting = false;
        this.reach = reach(motion.coordinates);
        this.look(motion.header.start);
        new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
        this.resize();
    }

    /** Sets the view along axes of the header (right, up, towards the viewer), so that all of the motion fits. */
    look(view) {
        this.aim(view.map((axis) => new THREE.Vector3(...axis)), this.motion.coordinates);
    }

    /** Sets the view so that the current state fills the picture. */
    fit() {
        const axes = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()];
        this.camera.matrixWorld.extractBasis(...axes);
        this.aim(axes, this.paper.geometry.attributes.position.array);
    }

    aim(axes, points) {
        const [, up, toward] = axes;
        const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
        const point = new THREE.Vector3();
        for (let i = 0; i < points.length; i += 3) {
            point.fromArray(points, i);
            axes.forEach((axis, k) => {
                const distance = axis.dot(point);
                low[k] = Math.min(low[k], distance);
                high[k] = Math.max(high[k], distance);
            });
        }
        const target = new THREE.Vector3();
        axes.forEach((axis, k) => target.addScaledVector(axis, (low[k] + high[k]) / 2));
        this.size = [0, 1].map((k) => Math.max(high[k] - low[k], 1e-9));
        // Straight from above the turn about the vertical is lost: a little from the view's lower side keeps it.
        toward.addScaledVector(up, Math.abs(toward.z) > 0.9999 ? -1e-4 : 0).normalize();
        this.camera.position.copy(target).addScaledVector(toward, 4 * this.reach);
        this.camera.near = this.reach;
        this.camera.far = 7 * this.reach;
        this.camera.zoom = 1;
        this.controls.target.copy(target);
        this.controls.update();
        this.frame();
    }

    /** Fits the frustum to the shape of the canvas. */
    frame() {
        const { clientWidth, clientHeight } = this.canvas;
        const aspect = clientWidth / Math.max(clientHeight, 1);
        const height = MARGIN * Math.max(this.size[1], this.size[0] / Math.max(aspect, 1e-3));
        this.camera.top = height / 2;
        this.camera.bottom = -height / 2;
        this.camera.right = (aspect * height) / 2;
        this.camera.left = -this.camera.right;
        this.camera.updateProjectionMatrix();
        this.request();
    }

    resize() {
        const { clientWidth, clientHeight } = this.canvas;
        const ratio = Math.min(window.devicePixelRatio || 1, 3);
        this.paper.setLines(ratio, clientWidth);
        this.renderer.setPixelRatio(ratio);
        this.renderer.setSize(clientWidth, clientHeight, false);
        this.frame();
        this.draw();
    }

    request() {
        if (this.isWaiting) return;
        this.isWaiting = true;
        requestAnimationFrame(() => this.draw());
    }

    draw() {
        this.isWaiting = false;
        this.renderer.render(this.scene, this.camera);
    }

    /** The triangle under the pointer, −1 if there is none. */
    pointed(event) {
        const box = this.canvas.getBoundingClientRect();
        const x = (2 * (event.clientX - box.left)) / box.width - 1;
        const y = 1 - (2 * (event.clientY - box.top)) / box.height;
        this.caster.setFromCamera(new THREE.Vector2(x, y), this.camera);
        const hits = this.caster.intersectObject(this.paper.mesh);
        return hits.length ? hits[0].faceIndex : -1;
    }
}

