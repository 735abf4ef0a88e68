// node validate_gltf.mjs MODULE FILE...: Khronos' glTF validator over files, one line each; exit code 1 on any error.
// MODULE is the folder of the npm package gltf-validator.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { resolve } from 'node:path';

const [module, ...files] = process.argv.slice(2);
const validator = createRequire(import.meta.url)(resolve(module));
const severities = ['errors', 'warnings', 'infos', 'hints'];

let errors = 0;
for (const file of files) {
    const report = await validator.validateBytes(new Uint8Array(await readFile(file)), { uri: file, maxIssues: 0 });
    const { issues } = report;
    errors += issues.numErrors;
    console.log(`${file}: ${issues.numErrors} errors, ${issues.numWarnings} warnings`);
    for (const message of issues.messages.filter(({ severity }) => severity <= 1).slice(0, 20)) {
        console.log(`  ${severities[message.severity]}: ${message.code} ${message.pointer ?? ''}: ${message.message}`);
    }
}
console.log(`${files.length} files, ${errors} errors (validator ${validator.version()})`);
process.exit(errors > 0 ? 1 : 0);
