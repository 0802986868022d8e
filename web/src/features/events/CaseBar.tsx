// Saves the trial as a test case, opens a saved one, and shows the opened one.

import { For, Show, type JSX } from 'solid-js';
import { sessionPath } from '../../net/session';
import type { Lab } from '../../lab/slices';
import { FileButton } from '../../ui/FileButton';
import { caseWords, openCase } from './cases';
import { addressOf } from '../../net/base';

export function CaseBar(props: { lab: Lab }): JSX.Element {
  const { lab } = props;
  /** A case needs a delivery that it can expect. */
  const caseAddress = (): string | undefined => {
    const state = lab.state();
    if (!state || (!state.goal_m && state.deliveries === 0)) return undefined;
    return addressOf(sessionPath(lab.session, 'case.json'));
  };
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
        <Show when={caseAddress()}>
          {(address) => (
            <a
              class="button"
              href={address()}
              download=""
              title="The trial with all inputs, as a file. In tests/cases it becomes a test"
            >
              Keep as test case
            </a>
          )}
        </Show>
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
