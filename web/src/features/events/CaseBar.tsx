// Saves the trial as a test case, opens a saved one, and shows the opened one.

import { For, Show, type JSX } from 'solid-js';
import type { Lab } from '../../lab/slices';
import { FileButton } from '../../ui/FileButton';
import { CaseLink } from './CaseLink';
import { caseWords, openCase } from './cases';

export function CaseBar(props: { lab: Lab }): JSX.Element {
  const { lab } = props;
  const words = (): string[] => {
    const [scene, state] = [lab.scene(), lab.state()];
    return scene?.case && state ? caseWords(scene.case, lab.marks(), state, scene.tick_s) : [];
  };
  return (
    <>
      <Show when={words().length > 0}>
        <div class="case-words">
          <For each={words()}>{(sentence) => <p>{sentence}</p>}</For>
        </div>
      </Show>
      <footer class="inspector-foot">
        <CaseLink lab={lab}>Keep as test case</CaseLink>
        <FileButton
          class="ghost"
          accept=".json,application/json"
          inputName="File of the test case"
          disabled={!lab.canOperate()}
          title="Sets the trial up and repeats its inputs. A file can also be dropped on the page"
          onFile={(file) => void openCase(lab, file)}
        >
          Open test case…
        </FileButton>
      </footer>
    </>
  );
}
