// Starts the page.

import './styles/tokens.css';
import './styles/type.css';
import './styles/reset.css';
import './ui/buttons.css';
import './ui/controls.css';
import './ui/text.css';
import type { JSX } from 'solid-js';
import { render } from 'solid-js/web';
import { keepFocus } from './app/focus';
import { Page } from './app/Page';
import { carriesToken, takeToken } from './net/loginToken';
import { isBoard, isDemo } from './net/session';
import { lazyView } from './ui/lazyPart';
import { theme } from './ui/theme';

// A login link in a browser that is already logged in: remove the token from the address.
takeToken(window);
// The same link opened in this tab changes only the hash: load the page as if the link was opened in a new tab.
window.addEventListener('hashchange', (event) => {
  if (!carriesToken(window)) return;
  event.stopImmediatePropagation();
  window.location.reload();
});

const root = document.getElementById('app');
if (!root) throw new Error('index.html has no #app');
// Before anything is drawn.
theme();
keepFocus(document);
/** Loaded when they are opened: most browsers never do. */
const DemoPage = lazyView(() => import('./app/DemoPage'));
const BoardPage = lazyView(() => import('./features/board/BoardPage'));
/** What older browsers lack that the page needs; without it they would show a part of the page. */
const isOld = !('toSorted' in Array.prototype) || !CSS.supports('selector(:has(*))');
// The message for older browsers is in index.html.
if (isOld) root.dataset.old = '';
else root.replaceChildren();
const show = (): JSX.Element => {
  if (isBoard(window.location)) return <BoardPage />;
  return isDemo(window.location) ? <DemoPage /> : <Page />;
};
if (!isOld) render(show, root);
