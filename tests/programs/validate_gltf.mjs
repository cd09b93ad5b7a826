// Validates glTF files with the Khronos validator; prints one JSON object per file:
// {file, errors, warnings, messages}. Exit status 1 when a file has an error or a warning.
import {readFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import validator from 'gltf-validator';

let clean = true;
for (const file of process.argv.slice(2)) {
  const beside = (uri) => join(dirname(file), decodeURIComponent(uri));
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {
    maxIssues: 20,
    externalResourceFunction: async (uri) => new Uint8Array(readFileSync(beside(uri))),
  });
  const {numErrors: errors, numWarnings: warnings, messages} = report.issues;
  clean &&= errors === 0 && warnings === 0;
  console.log(JSON.stringify({
    file,
    errors,
    warnings,
    messages: messages.map(({code, message, pointer, severity}) => ({code, message, pointer, severity})),
  }));
}
process.exitCode = clean ? 0 : 1;
