// The policies of the server: those that are shipped, trained here, or uploaded.

import { For, Show, createMemo, createSignal, type JSX } from 'solid-js';
import { freeName, mapName } from '../../lab/maps';
import type { Session, Trial } from '../../lab/slices';
import type { PolicySummary } from '../../net/protocol.gen';
import { FileButton } from '../../ui/FileButton';
import type { Palette } from '../../ui/palette';
import type { Theme } from '../../ui/theme';
import { PolicyRow } from './PolicyRow';
import { policyOf } from './policyUse';
import { nameFault } from './recipes';
import { discardPolicy, renamePolicy, uploadPolicy } from './trainings';
import './policies.css';

const ENDING = '.safetensors';

export function PoliciesPanel(props: {
  lab: Session & Trial;
  palette: () => Palette;
  theme: () => Theme;
  onUse: (policy: PolicySummary) => void;
}): JSX.Element {
  const { lab } = props;
  /** Why the last change was refused. */
  const [refusal, setRefusal] = createSignal<string>();
  const all = (): readonly PolicySummary[] => lab.catalog.policies() ?? [];
  const names = createMemo(() => all().map(({ name }) => name), [], {
    equals: (a, b) => a.join() === b.join(),
  });
  const used = createMemo(() => policyOf(all(), lab.scene()?.parameters.rl_policy)?.name);
  const byName = (name: string): PolicySummary | undefined =>
    all().find((policy) => policy.name === name);
  const attempt = async (change: () => Promise<unknown>): Promise<boolean> => {
    setRefusal(undefined);
    try {
      await change();
      return true;
    } catch (reason) {
      setRefusal(reason instanceof Error ? reason.message : String(reason));
      return false;
    }
  };
  const rename = (name: string, next: string): Promise<boolean> =>
    attempt(async () => {
      const fault = nameFault(next);
      if (fault !== undefined) throw new Error(fault);
      await renamePolicy(name, next);
    });
  const upload = (file: File): Promise<boolean> =>
    attempt(() => {
      const wanted = mapName(file.name.replace(ENDING, '')) || 'policy';
      return uploadPolicy(freeName(wanted, names()), file);
    });
  return (
    <section class="panel policies" aria-label="Policies">
      <header class="panel-head">
        <h2>Policies</h2>
        <FileButton
          accept={ENDING}
          inputName="File of a policy"
          class="small"
          disabled={!lab.canOperate()}
          title={
            lab.canOperate()
              ? 'Adds a policy that was downloaded from a Ferry server'
              : 'Only the operator can do this'
          }
          onFile={(file) => void upload(file)}
        >
          Upload policy…
        </FileButton>
      </header>
      <div role="alert">
        <Show when={refusal()}>{(text) => <p class="refusal">{text()}</p>}</Show>
      </div>
      <div class="policies-frame" tabindex="-1">
        <table>
          <thead>
            <tr>
              <th scope="col">Policy</th>
              <th scope="col">Maps</th>
              <th scope="col" class="number">
                Updates
              </th>
              <th scope="col" class="number" title="Episodes that reached their goals">
                Examination
              </th>
              <th scope="col" class="number">
                Seed
              </th>
              <th scope="col">
                <span class="visually-hidden">Use, download, rename and delete</span>
              </th>
            </tr>
          </thead>
          <tbody>
            {/* By name: a row stays, with the focus in it, when the list is read again. */}
            <For each={names()}>
              {(name) => (
                <Show when={byName(name)}>
                  {(policy) => (
                    <PolicyRow
                      policy={policy()}
                      canOperate={lab.canOperate()}
                      isUsed={used() === name}
                      palette={props.palette}
                      theme={props.theme}
                      onUse={() => {
                        props.onUse(policy());
                      }}
                      onRename={(next) => rename(name, next)}
                      onDelete={() => attempt(() => discardPolicy(name))}
                    />
                  )}
                </Show>
              )}
            </For>
          </tbody>
        </table>
      </div>
    </section>
  );
}
