// The notice for an experiment link that was not loaded, with the reason.

import { Match, Switch, type JSX } from 'solid-js';
import { experimentWords } from '../../lab/experimentLink';
import { OwnSessionButton } from '../../lab/OwnSessionButton';
import type { PageExperiment } from '../../lab/pageExperiment';
import type { Session } from '../../lab/slices';
import { CloseButton } from '../../ui/CloseButton';
import './share.css';

export function ExperimentNotice(props: { lab: Session; links: PageExperiment }): JSX.Element {
  const { lab, links } = props;
  const close = <CloseButton label="Dismiss the link" onClose={links.forget} />;
  // The region is always in the document: screen readers announce what appears inside it.
  return (
    <div class="link-bar" role="alert" aria-label="Link">
      <Switch>
        <Match when={links.broken()}>
          {(why) => (
            <p class="link-broken">
              <span>{why()}</span>
              {close}
            </p>
          )}
        </Match>
        <Match when={links.requested()}>
          {(experiment) => (
            <p>
              <span>This link asks for {experimentWords(experiment())}.</span>
              <OwnSessionButton class="small primary" rest={links.hash()}>
                Open it in your own session
              </OwnSessionButton>
              <button
                type="button"
                class="small"
                disabled={lab.connection().kind !== 'live'}
                onClick={() => links.load()}
              >
                Load it here
              </button>
              {close}
            </p>
          )}
        </Match>
      </Switch>
    </div>
  );
}
