// What the page offers to others: links to its session, experiment, lesson and challenge, pictures, and files.

import { For, Show, createResource, type JSX } from 'solid-js';
import { Share2 } from 'lucide';
import { drawingForLink } from '../../lab/drawingLink';
import type { PageExperiment } from '../../lab/pageExperiment';
import { addressOf } from '../../net/base';
import { Icon } from '../../ui/Icon';
import { createPopover } from '../../ui/popover';
import { LinkRow } from '../../ui/LinkRow';
import './share.css';

/** A link to what is open on the page. */
export interface Shared {
  readonly title: string;
  readonly address: string;
  /** What it leads to. */
  readonly words: string;
}

export function ShareButton(props: {
  session: string;
  links: PageExperiment;
  /** The map of the experiment. */
  map: string | undefined;
  /** Links to the open lesson and challenge. */
  open: readonly Shared[];
  /** Below the links. */
  children: JSX.Element;
  /** Links to files, below that. */
  files: JSX.Element;
}): JSX.Element {
  const popover = createPopover('share');
  // Asked for when the link is.
  const [drawn] = createResource(() => (popover.open() ? props.map : undefined), drawingForLink);
  const address = (path: string): string => window.location.origin + addressOf(path);
  const copy = (): string => {
    const { text } = drawn() ?? {};
    const drawing = text === undefined ? '' : `&drawing=${text}`;
    return `${address('/copy/')}${props.links.now() ?? ''}${drawing}`;
  };
  return (
    <div {...popover.box} class="share">
      <button
        {...popover.button}
        aria-label="Share"
        title="Share: links, pictures, videos and files"
        disabled={props.links.now() === undefined}
      >
        <Icon of={Share2} />
        <span class="share-word">Share</span>
      </button>
      <Show when={popover.open()}>
        <div id="share" class="popover of-top share-box" role="group" aria-label="Share">
          <LinkRow title="Watch this" address={address(`/s/${props.session}?watch`)}>
            This session: all see what happens here. One steers, and others may ask for control.
          </LinkRow>
          <For each={props.open}>
            {(one) => (
              <LinkRow title={one.title} address={one.address}>
                {one.words}
              </LinkRow>
            )}
          </For>
          <LinkRow title="A copy for each" address={copy()}>
            This experiment, in a session of the reader’s own: map, seed, start, goal, controller,
            changed parameters and scripted disturbances, from the start of this trial. What you did
            by hand is not in it. {drawn()?.remark}
          </LinkRow>
          {props.children}
          <section class="share-files" aria-label="Files">
            <div class="buttons">{props.files}</div>
            <p class="hint">
              A test case repeats this trial with all its inputs. The recording has the whole
              session: for Rerun, and as a log for “ferry replay”.
            </p>
          </section>
        </div>
      </Show>
    </div>
  );
}
