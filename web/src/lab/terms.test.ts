import { readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import { TERMS } from './terms';

const GLOSSARY = readFileSync(new URL('../../../docs/glossary.md', import.meta.url), 'utf8');

it.each(Object.entries(TERMS))('the tooltip of “%s” is in the glossary', (term, text) => {
  expect(GLOSSARY).toContain(`| ${term} | ${text} |`);
});
