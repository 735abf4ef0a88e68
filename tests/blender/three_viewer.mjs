// node three_viewer.mjs THREE FILE.glb...: opens each file with three.js' GLTFLoader in headless Chromium, as viewers do that
// know nothing of Supple's extensions; exit code 1 if one does not open or shows nothing. THREE is the folder of the npm
// package three. Exit code 77 where there is no Chromium.
import { spawn, spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { basename, extname, join, resolve } from 'node:path';

const [three, ...files] = process.argv.slice(2);
const secondsForAll = 240;

const page = `<!doctype html><script type="importmap">
{"imports": {"three": "/three/build/three.module.js", "three/addons/": "/three/examples/jsm/"}}</script>
<script type="module">
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

const say = text => fetch('/said', { method: 'POST', body: text });
const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
renderer.setSize(128, 128);

// How much of the picture is not background, half way through the first clip.
function coverage(gltf) {
    const scene = new THREE.Scene();
    scene.add(gltf.scene, new THREE.HemisphereLight(0xffffff, 0xffffff, 3));
    if (gltf.animations.length > 0) {
        const mixer = new THREE.AnimationMixer(gltf.scene);
        mixer.clipAction(gltf.animations[0]).play();
        mixer.setTime(gltf.animations[0].duration / 2);
    }
    scene.updateMatrixWorld(true);
    const box = new THREE.Box3().setFromObject(gltf.scene, true);
    const center = box.getCenter(new THREE.Vector3());
    const size = box.getSize(new THREE.Vector3()).length();
    const camera = new THREE.PerspectiveCamera(40, 1, size / 100, size * 10);
    camera.position.copy(center).add(new THREE.Vector3(0.5, 0.3, 1).normalize().multiplyScalar(size * 1.3));
    camera.lookAt(center);
    renderer.setClearColor(0x00ff00);
    renderer.render(scene, camera);
    const context = renderer.getContext();
    const pixels = new Uint8Array(128 * 128 * 4);
    context.readPixels(0, 0, 128, 128, context.RGBA, context.UNSIGNED_BYTE, pixels);
    let drawn = 0;
    for (let i = 0; i < pixels.length; i += 4) {
        drawn += pixels[i] === 0 && pixels[i + 1] === 255 && pixels[i + 2] === 0 ? 0 : 1;
    }
    return drawn / (128 * 128);
}

for (let i = 0; i < FILES; ++i) {
    try {
        const gltf = await new GLTFLoader().loadAsync('/file/' + i);
        let triangles = 0;
        gltf.scene.traverse(object => { triangles += object.isMesh ? object.geometry.index.count / 3 : 0; });
        await say(JSON.stringify({ i, triangles, clips: gltf.animations.length, coverage: coverage(gltf) }));
    } catch (error) {
        await say(JSON.stringify({ i, error: String(error) }));
    }
}
await say('done');
</script>`;

const chromium = ['chromium', 'chromium-browser', 'google-chrome'].find(name => spawnSync(name, ['--version']).status === 0);
if (!chromium) {
    console.log(`skipped: ${files.length} files left out: there is no Chromium`);
    process.exit(77);
}

const answers = [];
const server = createServer((request, response) => {
    if (request.url === '/said') {
        let text = '';
        request.on('data', part => { text += part; });
        request.on('end', () => {
            response.end();
            text === 'done' ? stopBrowser() : answers.push(JSON.parse(text));
        });
        return;
    }
    try {
        const body = request.url === '/' ? page.replace('FILES', String(files.length))
            : request.url.startsWith('/file/') ? readFileSync(files[Number(request.url.slice(6))])
            : readFileSync(join(resolve(three), request.url.replace(/^\/three\//, '')));
        const types = { '.js': 'text/javascript', '': 'application/octet-stream' };
        response.setHeader('Content-Type', request.url === '/' ? 'text/html' : types[extname(request.url)] ?? types['']);
        response.end(body);
    } catch {
        response.statusCode = 404;
        response.end();
    }
});

let browser;
const profile = mkdtempSync(join(tmpdir(), 'supple_three_'));

function stopBrowser() {
    if (browser.exitCode === null && browser.signalCode === null) {
        process.kill(-browser.pid, 'SIGKILL');
    }
}

// Chromium's children outlive it for a moment and may still write into the profile.
function removeProfile(triesLeft) {
    try {
        rmSync(profile, { recursive: true, force: true });
    } catch (error) {
        if (triesLeft > 0) {
            setTimeout(() => removeProfile(triesLeft - 1), 100);
            return;
        }
        console.log(`the browser's profile could not be removed: ${error}`);
    }
    report();
}

function report() {
    let failed = 0;
    files.forEach((file, i) => {
        const answer = answers.find(a => a.i === i) ?? { error: 'not opened' };
        const bad = answer.error !== undefined || answer.triangles === 0 || !(answer.coverage > 0.01);
        failed += bad ? 1 : 0;
        if (bad) {
            console.log(`FAILED: ${basename(file)}: ${JSON.stringify(answer)}`);
        }
    });
    const revision = JSON.parse(readFileSync(join(three, 'package.json'))).version;
    console.log(`${files.length - failed} of ${files.length} files opened and shown by three.js ${revision}`);
    process.exit(failed > 0 || files.length === 0 ? 1 : 0);
}

server.listen(0, '127.0.0.1', () => {
    // tools/test.sh tunes the C library's allocator for the tests. Chromium opens no page with that tuning.
    const { GLIBC_TUNABLES, ...environment } = process.env;
    browser = spawn(chromium, ['--headless', '--no-sandbox', '--no-first-run', '--disable-background-networking',
        '--disable-component-update', '--disable-sync', '--disable-gpu-sandbox', '--use-angle=swiftshader',
        '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist', `--user-data-dir=${profile}`,
        `http://127.0.0.1:${server.address().port}/`], { stdio: 'ignore', env: environment, detached: true });
    browser.on('exit', () => {
        server.close();
        removeProfile(50);
    });
    setTimeout(stopBrowser, secondsForAll * 1000).unref();
});
