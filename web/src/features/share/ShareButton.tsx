// The links that the page offers: to its session, and to its experiment.

import { Show, createResource, type JSX } from 'solid-js';
import { Share2 } from 'lucide';
import { drawingForLink } from '../../lab/drawingLink';
import type { PageExperiment } from '../../lab/pageExperiment';
import { addressOf } from '../../net/base';
import { Icon } from '../../ui/Icon';
import { createPopover } from '../../ui/popover';
import { LinkRow } from './LinkRow';
import './share.css';

export function ShareButton(props: {
  session: string;
  links: PageExperiment;
  /** The map of the experiment. */
  map: string | undefined;
  /** Below the links. */
  children: JSX.Element;
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
        title="Share: a link, a picture or a video"
        disabled={props.links.now() === undefined}
      >
        <Icon of={Share2} />
        <span class="share-word">Share</span>
      </button>
      <Show when={popover.open()}>
        <div id="share" class="popover of-top share-box" role="group" aria-label="Share">
          <LinkRow title="Watch this" address={address(`/s/${props.session}`)}>
            This session: all see what happens here, and one of them operates it.
          </LinkRow>
          <LinkRow title="A copy for each" address={copy()}>
            This experiment, in a session of the reader’s own: map, seed, start, goal, controller,
            changed parameters and scripted disturbances, from the start of this trial. What you did
            by hand is not in it. {drawn()?.remark}
          </LinkRow>
          {props.children}
        </div>
      </Show>
    </div>
  );
}
