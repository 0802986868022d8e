import { chromium } from 'playwright';
import http from 'node:http';
const S = { b: await chromium.launch({executablePath:'/usr/bin/chromium-headless-shell',args:['--no-sandbox','--disable-gpu','--disable-quic']}), log:[] };
S.open = async (name, opts={}, url='http://127.0.0.1:4777/') => {
  const c = await S.b.newContext({viewport:{width:1280,height:800},...opts});
  const p = await c.newPage(); S[name]=p; hook(p,name);
  await p.goto(url); return p; };
function hook(p,name){
  p.on('console',m=>{ if(m.type()!='log'&&m.type()!='info'&&m.type()!='debug') S.log.push(name+' '+m.type()+' '+m.text());});
  p.on('pageerror',e=>S.log.push(name+' PAGEERR '+e.message));
  p.on('response',r=>{ if(r.status()>=400) S.log.push(name+' '+r.status()+' '+r.url());});
  p.on('websocket',ws=>ws.on('framereceived',f=>{ if(typeof f.payload==='string'){try{const m=JSON.parse(f.payload); if(m.type==='state') p.st=m; else {p.other=p.other||[]; p.other.push(f.payload.slice(0,400)); if(p.other.length>200)p.other.shift();}}catch{}}}));
}
S.hook=hook; S.sleep=ms=>new Promise(r=>setTimeout(r,ms));
S.shot=(p,n)=>p.screenshot({path:`/tmp/eyes2/${n}.png`});
const AF=Object.getPrototypeOf(async()=>{}).constructor;
http.createServer((q,r)=>{let d='';q.on('data',x=>d+=x);q.on('end',async()=>{try{const v=await new AF('S',d)(S);r.end((typeof v==='string'?v:JSON.stringify(v,null,1)??'ok')+'\n');}catch(e){r.end('ERR '+e.stack+'\n');}});}).listen(4779,'127.0.0.1');
