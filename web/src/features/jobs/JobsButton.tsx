// The button of the top bar with the list of the server's jobs. It is there while there are any.

import { For, Show, createMemo, type JSX } from 'solid-js';
import { ListTodo } from 'lucide';
import type { Addressed, Panels, Session } from '../../lab/slices';
import { isActive } from '../../lab/trainingStage';
import type { JobSummary } from '../../net/protocol.gen';
import { counted } from '../../ui/format';
import { ForKeyed } from '../../ui/ForKeyed';
import { Icon } from '../../ui/Icon';
import { createPopover } from '../../ui/popover';
import { JobRow } from './JobRow';
import { groupsOf } from './words';
import './jobs.css';

const NONE: readonly JobSummary[] = [];

export default function JobsButton(props: { lab: Session & Addressed & Panels }): JSX.Element {
  const popover = createPopover('jobs');
  const jobs = createMemo(() => props.lab.catalog.jobs() ?? NONE);
  const active = (): number => jobs().filter(isActive).length;
  const groups = createMemo(() => groupsOf(jobs()));
  return (
    <Show when={jobs().length > 0}>
      <div {...popover.box} class="jobs">
        <button
          {...popover.button}
          class="jobs-button"
          aria-label={`Jobs: ${active()} not ended`}
          title={`The server’s work in the background: ${counted(active(), 'job')}`}
        >
          <Icon of={ListTodo} />
          <span>Jobs</span>
          <Show when={active() > 0}>
            <b class="number">{active()}</b>
          </Show>
        </button>
        <Show when={popover.open()}>
          <div id="jobs" class="popover of-top jobs-box" role="group" aria-label="Jobs">
            <For each={groups().map(({ title }) => title)}>
              {(title) => (
                <section aria-label={title}>
                  <h2>{title}</h2>
                  <ul>
                    <ForKeyed
                      each={groups().find((group) => group.title === title)?.jobs ?? NONE}
                      by={({ id }) => id}
                    >
                      {(job) => <JobRow lab={props.lab} job={job()} onShow={popover.close} />}
                    </ForKeyed>
                  </ul>
                </section>
              )}
            </For>
          </div>
        </Show>
      </div>
    </Show>
  );
}
